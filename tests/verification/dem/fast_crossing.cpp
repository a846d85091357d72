// Whoever is too fast for the step is found, whatever moves: a run never goes on with a particle behind the surface.
#include <gtest/gtest.h>

#include <numbers>

#include "base/error.hpp"
#include "shapes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using namespace shapes;

enum class Mover { particle, surface, both };

/// How runs of one kind ended.
struct Ends {
  int back = 0, refused = 0, behind = 0;
};

/// One particle and a flat surface that approach each other by `radii` radii in a step.
void approach(Mover mover, double radii, double degrees, double phase, Ends& ends) {
  Experiment experiment{.nodes = {{{-0.02, 0}}, {{0, 0}}, {{0.02, 0}}}, .particles = {}, .contact_times = 2.0};
  const double dt = rig::model_of(impacts::setup_of(experiment.law)).contact_time / experiment.steps_per_contact;
  const double speed = radii * radius / dt;
  const double of_surface = mover == Mover::particle ? 0.0 : mover == Mover::both ? 0.5 * speed : speed;
  const double of_particle = speed - of_surface;
  const double angle = degrees * std::numbers::pi / 180.0;
  experiment.particles.push_back({{{1e-3, radius * (1.0 + radii * phase)}},
                                  {{of_particle * std::sin(angle), -of_particle * std::cos(angle)}},
                                  0.0});
  experiment.path = [of_surface](double t, const Vec2& x) { return x + Vec2{{0.0, of_surface * t}}; };
  try {
    const Result result = carry_out(experiment);
    const double surface_at = of_surface * experiment.contact_times * experiment.steps_per_contact * dt;
    (result.copies[0].after.position[1] > surface_at ? ends.back : ends.behind) += 1;
  } catch (const NumericalError&) {
    ends.refused += 1;
  }
}

void check(const std::string& who, const std::string& quantity, double expected, double found) {
  verification::check({.group = "contact",
                       .name = "too fast for the step: " + who,
                       .quantity = quantity,
                       .unit = "",
                       .reference = "sent back, or the run refused",
                       .origin = "docs/theory/contact.md",
                       .expected = expected,
                       .found = found,
                       .tolerance = 0.0,
                       .reason = "exact: a count"});
}

void sweep(Mover mover, const std::string& who) {
  Ends slow;
  Ends fast;
  for (const double degrees : {0.0, 60.0}) {
    for (const double phase : {0.1, 0.4, 0.7}) {
      for (const double radii : {0.1, 0.3}) approach(mover, radii, degrees, phase, slow);
      for (const double radii : {0.6, 0.9, 1.1, 2.0, 3.0, 4.0, 5.0, 8.0, 20.0, 100.0}) {
        approach(mover, radii, degrees, phase, fast);
      }
    }
  }
  check(who, "runs of 60 at 0.6 to 100 radii per step that end behind the surface unnoticed", 0.0, fast.behind);
  check(who, "runs of 12 at 0.1 and 0.3 radii per step that end in front of it", 12.0, slow.back);
  EXPECT_GT(fast.refused, 40);
}

TEST(FastCrossing, OfAParticleIsFound) { sweep(Mover::particle, "the particle moves"); }
TEST(FastCrossing, OfTheSurfaceIsFound) { sweep(Mover::surface, "the surface moves"); }
TEST(FastCrossing, OfBothIsFound) { sweep(Mover::both, "both move"); }

}  // namespace
}  // namespace grainstep::dem
