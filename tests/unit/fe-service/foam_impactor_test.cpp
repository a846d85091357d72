/// @file The foam projectile as the orchestrator drives it, against a face that moves as told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "../../support/foam_rig.hpp"
#include "base/error.hpp"
#include "fe-service/preview.hpp"

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

scene::Impactor coarse_cylinder() {
  scene::Impactor impactor = test::reference_cylinder();
  scene::Foam& foam = *impactor.mutable_foam();
  foam.set_elements(20);
  return impactor;
}

FoamRig::Motion of_revolution(double speed = 0.0) {
  return {.height = [speed](double t) { return speed * t; }, .symmetry = scene::SYMMETRY_AXISYMMETRIC};
}

// The plan of a run is made with the one, the run itself with the other.
TEST(FoamImpactor, SaysTheSameInAPreviewAndWithItsModelBuilt) {
  FoamRig rig;
  rig.run(coarse_foam(), 1e-7);
  const wire::Ready previewed = preview_foam(coarse_foam(), {scene::SYMMETRY_PLANE_STRAIN, 1e-3, true}).ready();
  for (const wire::Ready& ready : {rig.ready, previewed}) {
    EXPECT_DOUBLE_EQ(ready.longest_window(), kFoamStepsPerWindow * ready.preferred_step());
    EXPECT_DOUBLE_EQ(ready.contact_time(), kFoamStepsPerContact * ready.preferred_step());
  }
  EXPECT_NEAR(previewed.preferred_step() / rig.ready.preferred_step(), 1.0, 1e-9);
  EXPECT_EQ(previewed.size(), rig.ready.size());
  EXPECT_EQ(previewed.counted(), "elements");
}

constexpr double event = 0.9e-3;  // s: until the block has left the wall

// On its way to locking every element is pressed together by far more than this.
TEST(FoamImpactor, AnElementThatCollapsesEndsTheRun) {
  FoamRig rig;
  rig.element_quality = 0.9;
  try {
    rig.run(coarse_foam(), event);
    FAIL() << "nothing was said";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("of its undeformed area, below guards.element_quality = 0.9"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("impactor.foam.elements"));
  }
}

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

// An elastic block at 0.09 of its wave's speed, 9% of strain: what the ledger misses is what the steps lose where nodes
// come and go, and falls with them.
TEST(FoamImpactor, AnElasticBlockKeepsItsEnergyAsStepsShrink) {
  scene::Impactor impactor = coarse_foam();
  impactor.mutable_slug()->set_speed(413.0);
  scene::Foam& foam = *impactor.mutable_foam();
  foam.set_strength(1e6);
  foam.set_shock_width(0.0);
  double before = 0.0;
  for (const double finer : {1.0, 2.0, 4.0}) {
    FoamRig rig(FoamRig::Motion{.finer = finer});
    rig.report_every = 1;
    rig.run(impactor, 3e-4);
    const double kinetic = rig.reports.front().energy().kinetic();
    double drift = 0.0;
    for (const wire::Report& report : rig.reports) {
      const wire::Energy& e = report.energy();
      drift = std::max(drift, std::abs(e.kinetic() + e.elastic() - e.interface_work() - kinetic) / kinetic);
    }
    EXPECT_LT(drift, 5e-5 / finer) << finer;
    if (before > 0.0) {
      EXPECT_GT(std::log2(before / drift), 1.0) << finer;
    }
    before = drift;
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
  EXPECT_NEAR(of_full, 2.0 * of_half, 1e-9 * of_full);
}

// Rings: mass, momentum and energy of the full cylinder, ledgers as in the plane, along r with the hoops' pull.
TEST(FoamImpactor, ACylinderClosesItsLedgers) {
  for (const double speed : {0.0, -60.0}) {
    FoamRig rig(of_revolution(speed));
    rig.run(coarse_cylinder(), 0.5e-3, 2);
    expect_ledgers_close(rig);
    const double mass = 540.0 * M_PI * 0.01 * 0.15;
    EXPECT_NEAR(rig.ready.mass(), mass, round_off * mass);
    EXPECT_NEAR(rig.reports.front().energy().kinetic(), 0.5 * mass * 320.8 * 320.8, 1e-9 * mass * 320.8 * 320.8);
    const double given = std::accumulate(rig.pressed.begin(), rig.pressed.end(), 0.0);
    EXPECT_GT(given, 0.9 * mass * (320.8 + speed));
    EXPECT_GT(std::abs(rig.reports.back().momentum().support_impulse(0)), 1e-3);  // hoops and axis do act
  }
}

TEST(FoamImpactor, NodesShareTheOutline) {
  for (const scene::Symmetry symmetry : {scene::SYMMETRY_PLANE_STRAIN, scene::SYMMETRY_AXISYMMETRIC}) {
    const bool ring = symmetry == scene::SYMMETRY_AXISYMMETRIC;
    const FoamModel model = make_foam_model(ring ? coarse_cylinder() : coarse_foam(),
                                            {.symmetry = symmetry, .depth = 1e-3, .mirror = !ring});
    const std::vector<double> areas = outline_areas(model.mesh, model.measure);
    const double found = std::accumulate(areas.begin(), areas.end(), 0.0);
    const double expected = ring ? 2.0 * M_PI * 0.1 * (0.1 + 0.15) : 1e-3 * (2.0 * 0.1 + 0.3);  // face, tail and side
    EXPECT_NEAR(found, expected, round_off * expected);
    EXPECT_EQ(areas.size(), outline(model.mesh).size());
  }
}

// (4.11) and (6.4), (4.13): what differs between discs and spheres.
TEST(FoamImpactor, ModulusAndLockingAreThoseOfTheParticles) {
  const FoamModel discs =
      make_foam_model(coarse_foam(), {.symmetry = scene::SYMMETRY_PLANE_STRAIN, .depth = 1e-3, .mirror = true});
  const FoamModel spheres =
      make_foam_model(coarse_cylinder(), {.symmetry = scene::SYMMETRY_AXISYMMETRIC, .depth = 1e-3, .mirror = false});
  const auto young = [](const Elastic& e) { return e.mu * (3.0 * e.lambda + 2.0 * e.mu) / (e.lambda + e.mu); };
  EXPECT_NEAR(young(discs.foam.elastic), 3.0 * std::sqrt(3.0) * 7.3e6 / 4e-3, 1.0);
  EXPECT_NEAR(young(spheres.foam.elastic), 4.0 * std::sqrt(2.0) * 7.3e6 / (3.0 * 200e-6), 10.0);
  EXPECT_NEAR(discs.foam.locked, std::log(0.9 / 0.2), 1e-12);
  EXPECT_NEAR(spheres.foam.locked, std::log(0.74 / 0.2), 1e-12);
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
  impactor = coarse_cylinder();
  impactor.mutable_slug()->set_offset(0.01);
  FoamRig of_rings(of_revolution());
  EXPECT_THROW(of_rings.run(impactor, 1e-5), InputError);
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
