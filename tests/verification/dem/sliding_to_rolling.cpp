// A disc that slides on a rough floor comes to roll: friction slows it and spins it up until the touched point rests.
// There is no gravity; the floor accelerates towards the disc instead, which presses as much as weight does.
#include <gtest/gtest.h>

#include "impacts.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using verification::Comparison;

constexpr double speed = 10.0;           // m/s
constexpr double friction = 0.7;         // mu
constexpr double contact_times = 100.0;  // of sliding
constexpr int steps_per_contact_time = 10;

struct Slide {
  double mass = 0.0, radius = 0.0;
  double acceleration = 0.0;                      ///< m/s^2, of the floor
  double duration = 0.0;                          ///< s, of sliding: v0/(3 mu a)
  std::vector<double> time{}, velocity{}, rim{};  ///< every step
  double friction_energy = 0.0;                   ///< J, at the end
};

/// Pressed in by the overlap that carries it from the start, so that it does not bounce.
Slide slide() {
  wire::Setup setup = impacts::setup_of({.friction = friction});
  const SlugModel model = rig::model_of(setup);
  const double dt = model.contact_time / steps_per_contact_time;
  Slide result{.mass = model.mass, .radius = model.diameter / 2.0};
  result.duration = contact_times * model.contact_time;
  result.acceleration = speed / (3.0 * friction * result.duration);
  const auto steps = static_cast<std::uint64_t>(3.0 * contact_times * steps_per_contact_time);
  wire::Start start = rig::start_of(dt, steps);
  start.set_snapshot_every(1);
  const double overlap = result.mass * result.acceleration / model.on_surface.stiffness;
  const auto rising = [&](std::uint64_t n, const surface::Vec2& x) {
    const double t = dt * static_cast<double>(n);
    return x + surface::Vec2{{0.0, 0.5 * result.acceleration * t * t}};
  };
  const PlacedParticle disc{{{0.0, result.radius - overlap}}, {{speed, 0.0}}, 0.0};
  const rig::ScriptedLink link = rig::run(setup, start, {disc}, rising);
  for (const wire::Snapshot& snapshot : link.snapshots) {
    const impacts::Motion2 motion = impacts::motion_of(snapshot, 0);
    result.time.push_back(dt * static_cast<double>(snapshot.window()));
    result.velocity.push_back(motion.tangential);
    result.rim.push_back(result.radius * motion.spin);
  }
  result.friction_energy = link.reports.back().energy().friction();
  return result;
}

void check(const std::string& quantity, const std::string& unit, double expected, double found, double tolerance,
           const std::string& reason) {
  verification::check({.group = "particles",
                       .name = "a sliding disc comes to roll",
                       .quantity = quantity,
                       .unit = unit,
                       .reference = "closed form",
                       .origin = "Coulomb friction and the angular momentum about the touched point, inertia m R^2/2",
                       .expected = expected,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = reason});
}

/// Mean over the last third of the run: the tangential spring has no dashpot and swings on.
double settled(const std::vector<double>& values) {
  const std::size_t from = values.size() * 2 / 3;
  double sum = 0.0;
  for (std::size_t i = from; i < values.size(); ++i) sum += values[i];
  return sum / static_cast<double>(values.size() - from);
}

TEST(SlidingToRolling, EndsAtTwoThirdsOfItsSpeed) {
  const Slide found = slide();
  constexpr const char* swinging = "discretisation: whole steps, and the swing of the tangential spring";
  check("velocity at the end", "m/s", 2.0 / 3.0 * speed, settled(found.velocity), 1e-3, swinging);
  check("rim speed at the end", "m/s", -2.0 / 3.0 * speed, settled(found.rim), 1e-3, swinging);
  const std::size_t begin = found.time.size() / 12;
  const std::size_t end = found.time.size() / 4;
  check("deceleration while sliding", "m/s^2", friction * found.acceleration,
        (found.velocity[begin] - found.velocity[end]) / (found.time[end] - found.time[begin]), 1e-6,
        "exact: steady sliding, but for a normal force that has not quite come to rest");
  check("energy that friction takes", "J", 0.5 * found.mass * speed * speed / 3.0, found.friction_energy, 1e-3,
        swinging);
  double worst = 0.0;
  for (std::size_t i = 0; i < found.time.size(); ++i) {
    worst = std::max(worst, std::abs(found.velocity[i] - 0.5 * found.rim[i] - speed) / speed);
  }
  check("largest change of the angular momentum about the floor, over the whole", "", 0.0, worst, 1e-12,
        "exact: round-off");
  verification::curve({.group = "particles",
                       .name = "a sliding disc comes to roll",
                       .title = "from sliding to rolling",
                       .x_label = "t (s)",
                       .y_label = "m/s",
                       .series = {{"velocity", found.time, found.velocity, {}},
                                  {"closed form",
                                   {0.0, found.duration, 3.0 * found.duration},
                                   {speed, 2.0 / 3.0 * speed, 2.0 / 3.0 * speed},
                                   verification::Series::Mark::line}}});
}

}  // namespace
}  // namespace grainstep::dem
