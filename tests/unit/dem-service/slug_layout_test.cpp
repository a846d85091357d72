// Where a slug stands at the start: its block turned, shifted, held off, stretched; and the walls that confine it.
#include "dem-service/slug/layout.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "contact/moving_surface.hpp"
#include "engine_rig.hpp"

namespace grainstep::dem {

using contact::MovingSurface;
namespace {

using rig::slug_of;
using surface::Vec3;

constexpr double round_off = 1e-12;  // m, of lengths of centimetres
constexpr double left = 1.1e-9;      // of a diameter: the gap that first touch leaves on purpose

wire::Setup setup_on_flat() {
  wire::Setup setup = rig::reference_setup();
  rig::set_flat_surface(setup, 0.5, 50);
  return setup;
}

std::vector<PlacedParticle> placed(const wire::Setup& setup) {
  return lay_out(rig::model_of(setup), MovingSurface(setup.impactor().surface()).now());
}

double lowest(const std::vector<PlacedParticle>& particles) {
  return std::ranges::min(particles, {}, [](const PlacedParticle& p) { return p.position[1]; }).position[1];
}

TEST(SlugLayout, TouchesAndMovesStraightDown) {
  const wire::Setup setup = setup_on_flat();
  const auto particles = placed(setup);
  EXPECT_NEAR(lowest(particles), 0.5e-3, left * 1e-3);
  for (const PlacedParticle& p : particles) {
    EXPECT_EQ(p.velocity[0], 0.0);
    EXPECT_EQ(p.velocity[1], -400.0);
    EXPECT_LE(std::abs(p.position[0]), 0.02);
  }
}

TEST(SlugLayout, TurnedSlugIsTheSameBlockSeenFromAnotherDirection) {
  wire::Setup setup = setup_on_flat();
  const auto straight = placed(setup);
  const double angle = std::numbers::pi / 6.0;
  slug_of(setup).set_angle(angle);
  slug_of(setup).set_offset(0.1);
  const auto turned = placed(setup);
  ASSERT_EQ(turned.size(), straight.size());
  EXPECT_NEAR(lowest(turned), 0.5e-3, left * 1e-3);
  const Vec3 lateral{{std::cos(angle), std::sin(angle)}};
  const Vec3 ahead{{std::sin(angle), -std::cos(angle)}};
  for (std::size_t i = 1; i < turned.size(); ++i) {
    const Vec3 before = straight[i].position - straight[0].position;
    const Vec3 after = turned[i].position - turned[0].position;
    ASSERT_NEAR(dot(after, lateral), before[0], round_off);
    ASSERT_NEAR(dot(after, ahead), -before[1], round_off);
    ASSERT_NEAR(dot(turned[i].velocity, ahead), 400.0, 400.0 * round_off);
  }
  // The middle of its head is at x1 = offset: a slug at mid-height lies upstream by its way along x1.
  double mean = 0.0;
  for (const PlacedParticle& p : turned) mean += p.position[0] / static_cast<double>(turned.size());
  EXPECT_NEAR(mean, 0.1 - 0.02 * std::sin(angle), 1e-3);
}

TEST(SlugLayout, StandsOffAndStretches) {
  wire::Setup setup = setup_on_flat();
  slug_of(setup).set_stand_off(0.03);
  slug_of(setup).set_tail_speed(100.0);
  const auto particles = placed(setup);
  EXPECT_NEAR(lowest(particles), 0.0305, left * 1e-3);
  for (const PlacedParticle& p : particles) {
    // The block's own coordinate is known up to the first touch's shift, which is below a diameter here.
    const double from_head = p.position[1] - 0.03;
    EXPECT_NEAR(p.velocity[1], -(400.0 - 300.0 * from_head / 0.04), 300.0 * 1e-3 / 0.04);
  }
}

TEST(SlugLayout, AMirrorOrWallsRefuseWhatHasNoPlaceBetweenThem) {
  wire::Setup setup = setup_on_flat();
  slug_of(setup).set_offset(0.1);
  setup.set_mirror(true);
  EXPECT_THROW((void)rig::model_of(setup), InputError);
  setup.set_mirror(false);
  EXPECT_NO_THROW((void)rig::model_of(setup));
  slug_of(setup).set_confined(true);
  EXPECT_THROW((void)rig::model_of(setup), InputError);
}

// Two particles against the walls of their strip on their way down: what the walls give them is in the ledger.
TEST(SlugLayout, WallsKeepTheSandInItsStripAndTheBalancesClosed) {
  wire::Setup setup = setup_on_flat();
  slug_of(setup).set_confined(true);
  const SlugModel model = rig::model_of(setup);
  const std::vector<PlacedParticle> particles{{{{0.0188, 0.01}}, {{30.0, 0.0}}, 0.0},
                                              {{{-0.0188, 0.02}}, {{-50.0, 0.0}}, 0.0}};
  const double dt = model.preferred_step;
  const auto link = rig::run(setup, rig::start_of(dt, 400), particles);
  const wire::Report& first = link.reports.front();
  const wire::Report& last = link.reports.back();
  constexpr double e = 0.7;
  constexpr double calibrated =
      1e-2;  // the mean over the phase of entry is e; a single entry at t_e/10 is off by up to this
  const auto& velocity = rig::field(link.snapshots.back(), "velocity").value();
  EXPECT_NEAR(velocity[0] / (-30.0 * e), 1.0, calibrated);
  EXPECT_NEAR(velocity[2] / (50.0 * e), 1.0, calibrated);
  const double given = last.momentum().linear(0) - first.momentum().linear(0);
  EXPECT_NEAR(last.momentum().support_impulse(0) / given, 1.0, 1e-12);
  const auto total = [](const wire::Energy& energy) { return energy.kinetic() + energy.elastic() + energy.damping(); };
  EXPECT_NEAR(total(last.energy()) / total(first.energy()), 1.0, 0.02);  // as any contact at t_e/10
}

}  // namespace
}  // namespace grainstep::dem
