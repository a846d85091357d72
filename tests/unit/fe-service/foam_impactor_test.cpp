/// @file The foam projectile as the orchestrator drives it, against a face that moves as told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "../../support/foam_rig.hpp"
#include "base/error.hpp"

namespace grainstep::fe {
namespace {

using test::FoamRig;
using test::reference_foam;

constexpr double round_off = 1e-12;

scene::Impactor coarse_foam() {
  scene::Impactor impactor = reference_foam();
  scene::Foam& foam = *impactor.mutable_foam();
  foam.set_elements(20);
  return impactor;
}

constexpr double event = 0.9e-3;  // s: until the block has left the wall

/// Momentum within round-off, energy within 1e-3, in every report of what the face has felt.
void expect_ledgers_close(const FoamRig& rig) {
  const wire::Report& first = rig.reports.front();
  const double kinetic = first.energy().kinetic();
  const double momentum = std::abs(first.momentum().linear(1));
  for (const wire::Report& report : rig.reports) {
    const wire::Momentum& m = report.momentum();
    for (const int c : {0, 1}) {
      EXPECT_NEAR(m.linear(c) - first.momentum().linear(c), m.interface_impulse(c) + m.support_impulse(c),
                  round_off * momentum);
    }
    const wire::Energy& e = report.energy();
    EXPECT_NEAR(e.kinetic() + e.elastic() + e.plastic() + e.damping() + e.friction() - e.interface_work(), kinetic,
                1e-3 * kinetic);
    EXPECT_GE(e.plastic(), 0.0);
  }
}

TEST(FoamImpactor, HasTheSlugsMassMomentumAndEnergy) {
  FoamRig rig;
  rig.run(coarse_foam(), 1e-5);
  const double mass = 540.0 * 0.1 * 0.3 * 1e-3;
  EXPECT_NEAR(rig.ready.mass(), mass, round_off * mass);
  EXPECT_EQ(rig.ready.size(), 4U * 20U * 7U);
  EXPECT_NEAR(rig.reports.front().momentum().linear(1), -mass * 400.0, round_off * mass * 400.0);
  EXPECT_NEAR(rig.reports.front().energy().kinetic(), 0.5 * mass * 160000.0, round_off * mass * 80000.0);
}

TEST(FoamImpactor, LedgersCloseOnAWallAtRestAndOneThatGives) {
  for (const double speed : {0.0, -60.0, 40.0}) {
    for (const std::uint32_t steps : {1U, 3U}) {
      FoamRig rig(FoamRig::Motion{.height = [speed](double t) { return speed * t; }});
      rig.run(coarse_foam(), event, steps);
      expect_ledgers_close(rig);
      const double given = std::accumulate(rig.pressed.begin(), rig.pressed.end(), 0.0);
      EXPECT_NEAR(given, rig.reports.back().momentum().interface_impulse(1), 1e-9 * given);
      EXPECT_NEAR(rig.observed(rig.reports.back(), "work_on_surface"), -given * speed, 1e-9 * given * 400.0);
      EXPECT_GT(given, 0.9 * rig.ready.mass() * (400.0 + speed));
    }
  }
}

TEST(FoamImpactor, AFullBlockIsTwoHalves) {
  FoamRig half;
  half.run(coarse_foam(), event);
  FoamRig full;
  full.run(coarse_foam(), event, 1, false);
  expect_ledgers_close(full);
  EXPECT_NEAR(full.ready.mass(), 2.0 * half.ready.mass(), round_off * full.ready.mass());
  const double of_half = std::accumulate(half.pressed.begin(), half.pressed.end(), 0.0);
  const double of_full = std::accumulate(full.pressed.begin(), full.pressed.end(), 0.0);
  // Discretisation: the node on the axis has half the mass in the half, but the same contact.
  EXPECT_NEAR(of_full, 2.0 * of_half, 2e-3 * of_full);
}

TEST(FoamImpactor, FrictionlessUnlessAsked) {
  FoamRig slippery(FoamRig::Motion{.sliding = 20.0});
  slippery.run(coarse_foam(), event, 1, false);
  for (const double along : slippery.along) EXPECT_EQ(along, 0.0);
  scene::Impactor rough = coarse_foam();
  scene::Foam& foam = *rough.mutable_foam();
  foam.set_friction(0.5);
  FoamRig rig(FoamRig::Motion{.sliding = 20.0});
  rig.run(rough, event, 1, false);
  expect_ledgers_close(rig);
  EXPECT_LT(std::accumulate(rig.along.begin(), rig.along.end(), 0.0), 0.0);  // the face is held back
  EXPECT_GT(rig.reports.back().energy().friction(), 0.0);
}

// Twenty to one: elements that lock need more steps than their undeformed size did.
TEST(FoamImpactor, TakesMoreStepsWhereElementsFlatten) {
  scene::Impactor impactor = coarse_foam();
  impactor.mutable_slug()->set_relative_density(0.045);
  FoamRig rig;
  rig.run(impactor, 1e-4, 4);
  const auto windows = static_cast<double>(rig.pressed.size() - 1);
  EXPECT_GE(static_cast<double>(rig.reports.back().timing().steps()), 4.0 * windows);
  expect_ledgers_close(rig);
}

TEST(FoamImpactor, StandOffDelaysAndTailSpeedTakesMomentumAway) {
  scene::Impactor impactor = coarse_foam();
  impactor.mutable_slug()->set_stand_off(0.02);
  impactor.mutable_slug()->set_tail_speed(300.0);
  FoamRig rig;
  rig.run(impactor, 2e-4);
  std::size_t first = 0;
  while (rig.pressed[first] == 0.0) ++first;
  EXPECT_NEAR(static_cast<double>(first) * rig.window, 0.02 / 400.0, 2.0 * rig.window);
  EXPECT_NEAR(rig.reports.front().momentum().linear(1), -350.0 * rig.ready.mass(), 1e-9 * 350.0 * rig.ready.mass());
}

TEST(FoamImpactor, AnObliqueBlockTouchesWithItsCorner) {
  scene::Impactor impactor = coarse_foam();
  impactor.mutable_slug()->set_angle(0.3);
  FoamRig rig;
  rig.run(impactor, 2e-4, 1, false);
  expect_ledgers_close(rig);
  EXPECT_GT(rig.reports.front().momentum().linear(0), 0.0);
  EXPECT_GT(rig.observed(rig.reports.back(), "contacts_with_surface"), 1.0);
}

TEST(FoamImpactor, RefusesWhatItCannotCompute) {
  const auto refusal = [](const scene::Impactor& impactor) -> std::string {
    FoamRig rig;
    try {
      rig.run(impactor, 1e-5);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  scene::Impactor impactor = coarse_foam();
  impactor.mutable_slug()->set_angle(0.2);
  EXPECT_THAT(refusal(impactor), testing::HasSubstr("structure.extent: full"));
  impactor = coarse_foam();
  impactor.mutable_slug()->set_relative_density(0.95);
  EXPECT_THAT(refusal(impactor), testing::HasSubstr("impactor.foam.densest"));
  impactor = coarse_foam();
  impactor.mutable_slug()->set_speed(0.0);
  EXPECT_THAT(refusal(impactor), testing::HasSubstr("above 0 for a foam"));
  impactor = coarse_foam();
  impactor.set_type(scene::Impactor::TYPE_SLUG);
  EXPECT_THAT(refusal(impactor), testing::HasSubstr("needs the type `foam`"));
}

// A node that comes through the face is named, with what to do.
TEST(FoamImpactor, ASoftContactIsSeen) {
  scene::Impactor impactor = coarse_foam();
  scene::Foam& foam = *impactor.mutable_foam();
  foam.set_contact_stiffness(1e-4);
  FoamRig rig;
  try {
    rig.run(impactor, event);
    ADD_FAILURE() << "nothing was seen";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("foam node"), testing::HasSubstr("contact_stiffness")));
  }
}

}  // namespace
}  // namespace grainstep::fe
