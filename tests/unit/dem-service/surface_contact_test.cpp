// Single particles on surfaces of every shape, through the real engine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "engine_rig.hpp"
#include "surface/polyline.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

struct Flight {
  std::vector<Vec2> nodes;
  PlacedParticle particle;
  std::uint64_t steps = 400;
  Motion motion = at_rest();
  double friction = 0.7;
  double restitution = 0.7;
};

double step_of_reference() { return model_of(reference_setup()).preferred_step; }
constexpr double radius = 0.5e-3;

ScriptedLink fly(const Flight& flight) {
  wire::Setup setup = reference_setup();
  slug_of(setup).mutable_particle()->set_friction(flight.friction);
  slug_of(setup).mutable_particle()->set_restitution(flight.restitution);
  set_surface(setup, flight.nodes);
  wire::Start start = start_of(step_of_reference(), flight.steps);
  start.set_report_every(1);
  start.set_snapshot_every(1);
  return run(setup, start, {flight.particle}, flight.motion);
}

Vec2 total_of(const wire::Forces& forces) {
  Vec2 sum;
  for (int i = 0; i < forces.impulse_size(); i += 2) sum += Vec2{{forces.impulse(i), forces.impulse(i + 1)}};
  return sum;
}

/// A particle pressed into the surface without bouncing, by an elastic contact that it oscillates in: how many steps in
/// touch with the surface have no or a backward force.
struct Touching {
  int steps = 0;
  int lost = 0;
  double largest_jump = 0.0;  ///< of the force between two steps, over the largest force
};

Touching contact_of(const ScriptedLink& link, const surface::Polyline& ground) {
  Touching result;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < ground.segment_count(); ++i) all.push_back(i);
  double largest = 0.0;
  double last = 0.0;
  for (std::size_t n = 0; n < link.snapshots.size(); ++n) {
    const auto& x = link.snapshots[n].position();
    const double distance = ground.closest({{x[0], x[1]}}, all).distance;
    const double force = norm(total_of(link.forces[n]));
    const double expected = std::max(0.0, radius - distance);
    result.steps += expected > 0.0 ? 1 : 0;
    result.lost += (expected > 0.0) != (force > 0.0) ? 1 : 0;
    if (n > 1) result.largest_jump = std::max(result.largest_jump, std::abs(force - last));
    largest = std::max(largest, force);
    last = force;
  }
  result.largest_jump /= largest;
  return result;
}

// docs/theory/step.md: at n = 0 an impulse acts for half a step, from then on for a whole one.
TEST(SurfaceContact, TheFirstImpulseIsThatOfHalfAStep) {
  const double overlap = 0.01 * radius;
  const double dt = step_of_reference();
  const ScriptedLink link = fly({.nodes = {{{-0.05, 0}}, {{0.05, 0}}},
                                 .particle = {{{0.0, radius - overlap}}, {}, 0.0},
                                 .steps = 1,
                                 .restitution = 1.0});
  const double stiffness = model_of(reference_setup()).surface_law.normal_stiffness;
  ASSERT_EQ(link.forces.size(), 2U);
  EXPECT_NEAR(total_of(link.forces[0])[1] / (-stiffness * overlap * dt / 2.0), 1.0, 1e-12);
  // The particle has moved a little: by a dt^2/2 with the stiffness over its mass, 0.2 of the overlap at t_e/10.
  EXPECT_NEAR(total_of(link.forces[1])[1] / (-stiffness * overlap * dt), 1.0, 0.1);
  EXPECT_EQ(link.reports.front().momentum().interface_impulse(1), 0.0) << "nothing has acted yet at t = 0";
}

TEST(SurfaceContact, OneContactAllTheWayOverAConvexCorner) {
  const std::vector<Vec2> nodes{{{-0.05, 0}}, {{0, 0}}, {{0.05, -0.01}}};
  const ScriptedLink link =
      fly({.nodes = nodes, .particle = {{{-1e-3, radius + 1e-6}}, {{60.0, -10.0}}, 0.0}, .restitution = 1.0});
  const Touching touching = contact_of(link, {nodes, {{0, 1}, {1, 2}}});
  EXPECT_GT(touching.steps, 10);
  EXPECT_EQ(touching.lost, 0);
}

TEST(SurfaceContact, OneContactIntoAFold) {
  const std::vector<Vec2> nodes{{{-0.05, 0}}, {{0, 0}}, {{0.05, 0.02}}};
  const ScriptedLink link =
      fly({.nodes = nodes, .particle = {{{-1e-3, radius + 1e-6}}, {{60.0, -10.0}}, 0.0}, .restitution = 1.0});
  const Touching touching = contact_of(link, {nodes, {{0, 1}, {1, 2}}});
  EXPECT_GT(touching.steps, 10);
  EXPECT_EQ(touching.lost, 0);
  EXPECT_GT(link.snapshots.back().point_field(1).value(1), 0.0);  // sent up the other side
}

TEST(SurfaceContact, HitsACornerHeadOnAndReturnsStraight) {
  const ScriptedLink link = fly({.nodes = {{{-0.05, -0.05}}, {{0, 0}}, {{0.05, -0.05}}},
                                 .particle = {{{0.0, radius + 1e-6}}, {{0.0, -100.0}}, 0.0},
                                 .restitution = 1.0});
  const wire::Field& velocity = field(link.snapshots.back(), "velocity");
  EXPECT_NEAR(velocity.value(0), 0.0, 1e-9);
  EXPECT_NEAR(velocity.value(1), 100.0, 2.0);  // elastic; one phase of entry, so not exactly
}

TEST(SurfaceContact, CentreInsideTheStructureIsPushedOut) {
  const ScriptedLink link = fly({.nodes = {{{-0.05, 0}}, {{0.05, 0}}},
                                 .particle = {{{0.0, -0.2 * radius}}, {{0.0, 0.0}}, 0.0},
                                 .restitution = 1.0});
  EXPECT_GT(link.snapshots.back().position(1), radius);
  EXPECT_LT(total_of(link.forces[1])[1], 0.0);
}

TEST(SurfaceContact, FrictionSpinsARollingParticle) {
  const ScriptedLink link =
      fly({.nodes = {{{-0.05, 0}}, {{0.05, 0}}}, .particle = {{{-0.02, radius + 1e-6}}, {{50.0, -50.0}}, 0.0}});
  EXPECT_LT(field(link.snapshots.back(), "angular_velocity").value(0), 0.0);  // rolls towards +x1: clockwise
  EXPECT_LT(field(link.snapshots.back(), "velocity").value(0), 50.0);
  EXPECT_GT(link.reports.back().energy().friction(), 0.0);
  const ScriptedLink smooth = fly({.nodes = {{{-0.05, 0}}, {{0.05, 0}}},
                                   .particle = {{{-0.02, radius + 1e-6}}, {{50.0, -50.0}}, 0.0},
                                   .friction = 0.0});
  EXPECT_EQ(field(smooth.snapshots.back(), "angular_velocity").value(0), 0.0);
  EXPECT_DOUBLE_EQ(field(smooth.snapshots.back(), "velocity").value(0), 50.0);
}

TEST(SurfaceContact, OnlyTheRelativeVelocityMatters) {
  const double dt = step_of_reference();
  const Vec2 drift{{30.0, -120.0}};
  const Flight still{.nodes = {{{-0.05, 0}}, {{0.0, 0}}, {{0.05, 0}}},
                     .particle = {{{1e-3, radius + 1e-6}}, {{40.0, -80.0}}, 0.0}};
  Flight moving = still;
  moving.particle.velocity += in_space(drift);
  moving.motion = [&](std::uint64_t n, const Vec2& x) { return x + drift * (static_cast<double>(n) * dt); };
  const ScriptedLink a = fly(still);
  const ScriptedLink b = fly(moving);
  double largest = 0.0;
  for (const wire::Forces& forces : a.forces) largest = std::max(largest, norm(total_of(forces)));
  for (std::size_t n = 0; n < a.forces.size(); ++n) {
    EXPECT_NEAR(norm(total_of(a.forces[n]) - total_of(b.forces[n])) / largest, 0.0, 1e-9) << n;
  }
  // In the moving frame the surface does work, and each side's account of it closes.
  const wire::Energy& energy = b.reports.back().energy();
  EXPECT_NEAR(energy.interface_work(), -observable(b.reports.back(), "work_on_surface"), 0.0);
  EXPECT_LT(energy.interface_work(), 0.0);  // the surface gives way
  const double start = b.reports.front().energy().kinetic();
  EXPECT_NEAR(
      (energy.kinetic() + energy.damping() + energy.friction() + energy.elastic() - energy.interface_work()) / start,
      (a.reports.back().energy().kinetic() + a.reports.back().energy().damping() +
       a.reports.back().energy().friction() - a.reports.front().energy().kinetic()) /
              start +
          1.0,
      1e-9);
}

TEST(SurfaceContact, ARotatingSegmentThrowsTheParticle) {
  const double dt = step_of_reference();
  const double rate = 2000.0;  // rad/s: 40 m/s at the particle
  const Flight flight{.nodes = {{{0, 0}}, {{0.05, 0}}},
                      .particle = {{{0.02, radius + 1e-5}}, {{0.0, 0.0}}, 0.0},
                      .steps = 300,
                      .motion =
                          [&](std::uint64_t n, const Vec2& x) {
                            const double angle = rate * static_cast<double>(n) * dt;
                            return Vec2{{x[0] * std::cos(angle), x[0] * std::sin(angle)}};
                          },
                      .friction = 0.0,
                      .restitution = 0.7};
  const ScriptedLink link = fly(flight);
  const double thrown = field(link.snapshots.back(), "velocity").value(1);
  EXPECT_NEAR(thrown, (1.0 + 0.7) * rate * 0.02, 0.06 * rate * 0.02);  // one phase of entry: 0.684 to 0.738
}

TEST(SurfaceContact, TunnellingIsRefusedWithParticleAndPlace) {
  try {
    (void)fly({.nodes = {{{-0.05, 0}}, {{0.05, 0}}}, .particle = {{{0.01, 1.5 * radius}}, {{0.0, -3800.0}}, 0.0}});
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("particle 1"));
    EXPECT_THAT(error.what(), testing::HasSubstr("tunnelled"));
    EXPECT_THAT(error.what(), testing::HasSubstr("x1 = 0.01"));
  }
}

}  // namespace
}  // namespace grainstep::dem
