// One pressure on one plate, given to the whole disc as a pressure is, and as a slice of a slug gives it: by spheres
// within the slice that touch the surface, whose forces are scaled to the full circle. The plate must not tell them
// apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../support/fe_scenes.hpp"
#include "contact/surface_contacts.hpp"
#include "fe-service/load/prescribed_load.hpp"
#include "fe-service/structure.hpp"
#include "load/pressure_history.hpp"
#include "participant/schedule.hpp"
#include "support/verification_record.hpp"

namespace grainstep {
namespace {

using contact::MovingSurface;
using surface::Vec2;
using surface::Vec3;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double span = 0.1;        // m
constexpr double thickness = 4e-3;  // m
constexpr double disc = 0.04;       // m, loaded; ends at a node
constexpr std::uint64_t windows = 1500;

wire::Setup plate() {
  scene::Structure structure = fe::test::beam(scene::Layer::MATERIAL_DH36, span, thickness, 4);
  structure.set_type(scene::Structure::TYPE_PLATE);
  wire::Setup setup = fe::test::setup_of(structure);
  setup.set_symmetry(scene::SYMMETRY_AXISYMMETRIC);
  return setup;
}

/// Bends the plate by some thicknesses, so that rings become cones and grow.
scene::Pressure pulse() {
  scene::Pressure pressure;
  pressure.mutable_patch()->set_from(0.0);
  pressure.mutable_patch()->set_to(disc);
  pressure.mutable_exponential()->set_peak(260e6);
  pressure.mutable_exponential()->set_decay_time(60e-6);
  return pressure;
}

/// The plate in one thread with what loads it: advances whenever its surface is asked for.
class Plate final : public participant::ImpactorLink {
 public:
  Plate() {
    ready_ = structure_.prepare(plate());
    start_.set_window(0.8 * ready_.preferred_step());
    start_.set_windows(windows);
    start_.set_impactor_steps(1);
    start_.set_structure_steps(1);
    start_.set_report_every(1);
    structure_.start(start_);
  }

  [[nodiscard]] const wire::Start& start() const { return start_; }
  [[nodiscard]] const wire::Surface& surface() const { return ready_.surface(); }

  const wire::Kinematics* surface(std::uint64_t /*window*/) override { return &next_; }
  [[nodiscard]] participant::Due due(std::uint64_t /*window*/) const override { return {}; }
  void send(const wire::Forces& forces) override {
    structure_.advance(forces, {.report = true, .snapshot = false}, next_);
    wire::Report report;
    structure_.report(report);
    structure_.complete();
    for (const wire::Observable& observable : report.observable()) {
      if (observable.name() == "deflection") deflection.push_back(observable.value());
    }
    for (int i = 1; i < forces.impulse_size(); i += 2) impulse -= forces.impulse(i);
  }
  void send(wire::Report& /*report*/) override {}
  void send(const wire::Snapshot& /*snapshot*/) override {}

  std::vector<double> deflection;  ///< m, at every window
  double impulse = 0.0;            ///< N s, along the axis

 private:
  fe::Structure structure_;
  wire::Ready ready_;
  wire::Start start_;
  wire::Kinematics next_;
};

void press_the_disc(Plate& plate) {
  wire::Setup setup;
  setup.set_symmetry(scene::SYMMETRY_AXISYMMETRIC);
  setup.mutable_impactor()->mutable_impactor()->set_type(scene::Impactor::TYPE_PRESSURE);
  *setup.mutable_impactor()->mutable_impactor()->mutable_pressure() = pulse();
  *setup.mutable_impactor()->mutable_surface() = plate.surface();
  fe::PrescribedLoad load;
  static_cast<void>(load.prepare(setup));
  load.run(plate.start(), plate);
}

/// Spheres that are pushed into the surface where Gauss's two points of every loaded ring are, each until its spring
/// carries the pressure's share there. Two points integrate r times the linear shape functions exactly.
class Spheres {
 public:
  Spheres(const MovingSurface& surface, double slice) : slice_(slice) {
    for (std::uint32_t s = 0; s < surface.now().segment_count(); ++s) {
      const auto [first, second] = surface.now().segment(s);
      const Vec2& a = surface.now().nodes()[first];
      const Vec2& b = surface.now().nodes()[second];
      if (b[0] - a[0] <= std::abs(b[1] - a[1]) || b[0] > disc + 1e-9) continue;
      for (const double side : {-1.0, 1.0}) points_.push_back({s, 0.5 + side * 0.5 / std::numbers::sqrt3});
    }
    const std::size_t count = points_.size();
    position_.resize(count);
    rest_.assign(count, still_.c.data());
    velocity_.assign(count, still_.c.data());
    radii_.assign(count, radius);
    springs_.resize(count);
    identity_.assign(count, 1);
    for (Vec3& p : position_) place_.push_back(p.c.data());
  }

  contact::ParticleArrays pushed(const MovingSurface& surface, double pressure) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto [first, second] = surface.now().segment(points_[i].segment);
      const Vec2& a = surface.now().nodes()[first];
      const Vec2 along = surface.now().nodes()[second] - a;
      const double length = norm(along);
      const Vec2 at = a + points_[i].fraction * along;
      const double force = pressure * slice_ * at[0] * 0.5 * length;
      const Vec2 centre = at + (radius - force / stiffness) / length * Vec2{{-along[1], along[0]}};
      const double theta = slice_ * (0.5 + static_cast<double>(i)) / static_cast<double>(points_.size());
      position_[i] = {{centre[0] * std::cos(theta), centre[1], centre[0] * std::sin(theta)}};
    }
    return {.owned = static_cast<int>(points_.size()),
            .position = place_.data(),
            .velocity = velocity_.data(),
            .spin = rest_.data(),
            .radius = radii_.data(),
            .mass = radii_.data(),  // no dashpot reads it
            .identity = identity_.data(),
            .spring = springs_.data()};
  }

  static constexpr double radius = 50e-6;  // m: the closest point stays the Gauss point where segments fold
  static constexpr double stiffness = 1e9;

 private:
  struct Point {
    std::uint32_t segment;
    double fraction;
  };
  double slice_;
  std::vector<Point> points_;
  std::vector<Vec3> position_, springs_;
  Vec3 still_;
  std::vector<const double*> place_, velocity_, rest_;
  std::vector<double> radii_;
  std::vector<std::int32_t> identity_;
};

void press_a_slice(Plate& plate, double slice) {
  MovingSurface surface(plate.surface());
  Spheres spheres(surface, slice);
  contact::SurfaceContacts contacts({.law = {.normal_stiffness = Spheres::stiffness},
                                     .shape = contact::Shape::revolved,
                                     .whole = 2.0 * std::numbers::pi / slice,
                                     .largest_radius = Spheres::radius});
  const double h = plate.start().window();
  for (std::uint64_t n = 0; n <= windows; ++n) {
    if (n > 0) {
      const wire::Kinematics& moved = *plate.surface(n);
      surface.arrive();
      surface.aim(moved.position().data(), moved.velocity().data());
      surface.move_to(1.0);
    }
    const double time = static_cast<double>(n);
    const double impulse = load::impulse(pulse(), std::max(0.0, time - 0.5) * h, (time + 0.5) * h);
    const contact::ParticleArrays particles = spheres.pushed(surface, impulse / h);
    contacts.rebuild(particles, surface);
    std::vector<Vec2> nodal(surface.node_count());
    ASSERT_FALSE(contacts.evaluate(particles, surface, 0.0, h, nodal));
    wire::Forces forces;
    forces.set_window(n);
    for (const Vec2& one : nodal) {
      forces.add_impulse(one[0]);
      forces.add_impulse(one[1]);
    }
    plate.send(forces);
  }
}

void check(const std::string& quantity, const std::string& unit, double expected, double found, double tolerance) {
  verification::check({.group = "coupled",
                       .name = "one pressure on one circular plate: full circle and slices",
                       .quantity = quantity,
                       .unit = unit,
                       .reference = "the pressure on the full circle",
                       .origin = "F = (2 pi/phi) sum of the slice's forces",
                       .expected = expected,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = "exact: round-off of 1500 steps"});
}

TEST(SlicePressure, ThePlateDoesNotTellASliceFromTheFullCircle) {
  Plate whole;
  press_the_disc(whole);
  const double peak = *std::max_element(whole.deflection.begin(), whole.deflection.end());
  EXPECT_GT(peak, 2.0 * thickness);
  for (const double degrees : {5.0, 10.0, 20.0, 90.0}) {
    Plate sliced;
    press_a_slice(sliced, degrees * degree);
    const std::string of = ", slice of " + std::to_string(static_cast<int>(degrees)) + " degrees";
    check("impulse along the axis" + of, "N s", whole.impulse, sliced.impulse, 1e-11);
    double worst = 0.0;
    for (std::size_t n = 0; n < whole.deflection.size(); ++n) {
      worst = verification::larger(worst, std::abs(sliced.deflection.at(n) - whole.deflection[n]) / peak);
    }
    check("largest difference of the deflection over its peak" + of, "", 0.0, worst, 1e-11);
  }
}

}  // namespace
}  // namespace grainstep
