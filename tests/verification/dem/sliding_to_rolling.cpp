// A disc or sphere that slides on a rough floor comes to roll: friction slows it and spins it up until the touched
// point rests. There is no gravity; the floor accelerates towards the body instead, which presses as much as weight
// does.
#include <gtest/gtest.h>

#include "../../unit/dem-service/slice_rig.hpp"
#include "impacts.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using surface::Vec3;
using verification::Comparison;

constexpr double speed = 10.0;           // m/s
constexpr double friction = 0.7;         // mu
constexpr double contact_times = 100.0;  // of sliding
constexpr int steps_per_contact_time = 10;

/// Velocity along the floor and that of the rim, m/s: their sum is the slip of the touched point.
struct Rolling {
  double velocity, rim;
};

/// What rolls: it starts at `radius` over a floor at rest.
struct Roller {
  std::string name;
  double inertia;  ///< moment of inertia over m R^2
  wire::Setup setup;
  PlacedParticle (*placed)(double height);
  Rolling (*motion)(const wire::Snapshot&, double radius);

  [[nodiscard]] double rolling_speed() const { return speed / (1.0 + inertia); }
};

Roller disc() {
  return {"disc", 0.5, impacts::setup_of({.friction = friction}),
          [](double height) {
            return PlacedParticle{{{0.0, height}}, {{speed, 0.0}}, 0.0};
          },
          [](const wire::Snapshot& snapshot, double radius) {
            const impacts::Motion2 motion = impacts::motion_of(snapshot, 0);
            return Rolling{motion.tangential, radius * motion.spin};
          }};
}

constexpr Vec3 up{{0.0, 1.0, 0.0}};
/// In the middle of a slice of 30 degrees, where rings are a plane to a sphere that leaves the axis.
Vec3 along() { return rig::outward(15.0 * rig::degree); }

Roller sphere() {
  wire::Setup setup = rig::slice_setup();
  rig::slug_of(setup).mutable_particle()->set_friction(friction);
  rig::slug_of(setup).mutable_surface_contact()->set_lever_arm(scene::SurfaceContact::LEVER_ARM_RADIUS);
  rig::set_rings(setup, 0.5, 100);
  return {"sphere", 0.4, setup,
          [](double height) {
            return PlacedParticle{0.1 * along() + height * up, speed * along(), {}};
          },
          [](const wire::Snapshot& snapshot, double radius) {
            const rig::Sphere now = rig::sphere_of(snapshot, 0);
            return Rolling{dot(now.velocity, along()), -radius * dot(now.spin, cross(up, along()))};
          }};
}

struct Slide {
  double mass = 0.0;
  double acceleration = 0.0;                      ///< m/s^2, of the floor
  double duration = 0.0;                          ///< s, of sliding: v0/((1 + 1/inertia) mu a)
  std::vector<double> time{}, velocity{}, rim{};  ///< every step
  double friction_energy = 0.0;                   ///< J, at the end
};

/// Pressed in by the overlap that carries it from the start, so that it does not bounce.
Slide slide(const Roller& roller) {
  const SlugModel model = rig::model_of(roller.setup);
  const double dt = model.contact_time / steps_per_contact_time;
  Slide result{.mass = model.mass};
  result.duration = contact_times * model.contact_time;
  result.acceleration = speed / ((1.0 + 1.0 / roller.inertia) * friction * result.duration);
  const auto steps = static_cast<std::uint64_t>(3.0 * contact_times * steps_per_contact_time);
  wire::Start start = rig::start_of(dt, steps);
  start.set_snapshot_every(1);
  const double overlap = result.mass * result.acceleration / model.on_surface.stiffness;
  const auto rising = [&](std::uint64_t n, const surface::Vec2& x) {
    const double t = dt * static_cast<double>(n);
    return x + surface::Vec2{{0.0, 0.5 * result.acceleration * t * t}};
  };
  const double radius = model.diameter / 2.0;
  const rig::ScriptedLink link = rig::run(roller.setup, start, {roller.placed(radius - overlap)}, rising);
  for (const wire::Snapshot& snapshot : link.snapshots) {
    const Rolling motion = roller.motion(snapshot, radius);
    result.time.push_back(dt * static_cast<double>(snapshot.window()));
    result.velocity.push_back(motion.velocity);
    result.rim.push_back(motion.rim);
  }
  result.friction_energy = link.reports.back().energy().friction() / model.whole();
  return result;
}

/// Mean over the last third of the run: the tangential spring has no dashpot and swings on.
double settled(const std::vector<double>& values) {
  const std::size_t from = values.size() * 2 / 3;
  double sum = 0.0;
  for (std::size_t i = from; i < values.size(); ++i) sum += values[i];
  return sum / static_cast<double>(values.size() - from);
}

void draw(const Roller& roller, const std::string& name, const Slide& found) {
  const double end = roller.rolling_speed();
  verification::curve({.group = "particles",
                       .name = name,
                       .title = "from sliding to rolling",
                       .x_label = "t (s)",
                       .y_label = "m/s",
                       .series = {{"velocity", found.time, found.velocity, {}},
                                  {"closed form",
                                   {0.0, found.duration, 3.0 * found.duration},
                                   {speed, end, end},
                                   verification::Series::Mark::line}}});
}

void check(const Roller& roller) {
  const Slide found = slide(roller);
  const std::string name = "a sliding " + roller.name + " comes to roll";
  const std::string of_the_body = roller.inertia == 0.5 ? "m R^2/2" : "2 m R^2/5";
  const auto compare = [&](const std::string& quantity, const std::string& unit, double expected, double value,
                           double tolerance, const std::string& reason) {
    verification::check(
        {.group = "particles",
         .name = name,
         .quantity = quantity,
         .unit = unit,
         .reference = "closed form",
         .origin = "Coulomb friction and the angular momentum about the touched point, inertia " + of_the_body,
         .expected = expected,
         .found = value,
         .tolerance = tolerance,
         .reason = reason});
  };
  const std::string swinging = "discretisation: whole steps, and the swing of the tangential spring";
  compare("velocity at the end", "m/s", roller.rolling_speed(), settled(found.velocity), 1e-3, swinging);
  compare("rim speed at the end", "m/s", -roller.rolling_speed(), settled(found.rim), 1e-3, swinging);
  const std::size_t begin = found.time.size() / 12;
  const std::size_t end = found.time.size() / 4;
  compare("deceleration while sliding", "m/s^2", friction * found.acceleration,
          (found.velocity[begin] - found.velocity[end]) / (found.time[end] - found.time[begin]), 1e-6,
          "exact: steady sliding, but for a normal force that has not quite come to rest");
  compare("energy that friction takes", "J", 0.5 * found.mass * speed * speed * roller.inertia / (1.0 + roller.inertia),
          found.friction_energy, 1e-3, swinging);
  double worst = 0.0;
  for (std::size_t i = 0; i < found.time.size(); ++i) {
    worst = verification::larger(worst, std::abs(found.velocity[i] - roller.inertia * found.rim[i] - speed) / speed);
  }
  compare("largest change of the angular momentum about the floor, over the whole", "", 0.0, worst, 1e-12,
          "exact: round-off");
  draw(roller, name, found);
}

TEST(SlidingToRolling, DiscEndsAtTwoThirdsOfItsSpeed) { check(disc()); }

TEST(SlidingToRolling, SphereEndsAtFiveSeventhsOfItsSpeed) { check(sphere()); }

}  // namespace
}  // namespace grainstep::dem
