#include "orchestrator/session/step_plan.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "participant/schedule.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

constexpr SideSteps impactor{.stable = 4e-8, .preferred = 2.4e-8, .contact_time = 2.4e-7};

scene::Scene automatic() {
  scene::Scene out;
  out.mutable_output()->set_rows(500);
  out.mutable_output()->set_snapshots(50);
  out.mutable_output()->set_profiles(30);
  return out;
}

StepPlan with_structure(double stable) {
  return plan_steps(automatic(), 3e-3, impactor, {.stable = stable, .preferred = stable});
}

std::string refusal_until(double end, const scene::Scene& scene, SideSteps structure = {1e-7, 1e-7}) {
  try {
    static_cast<void>(plan_steps(scene, end, impactor, structure));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const scene::Scene& scene, SideSteps structure = {1e-7, 1e-7}) {
  return refusal_until(3e-3, scene, structure);
}

TEST(StepPlan, ASlowerStructureTakesOneStepForSeveralOfTheImpactor) {
  const StepPlan plan = with_structure(1.3e-7);
  EXPECT_EQ(plan.impactor_steps, 5U);
  EXPECT_EQ(plan.structure_steps, 1U);
  EXPECT_DOUBLE_EQ(plan.window, 1.2e-7);
  EXPECT_DOUBLE_EQ(plan.structure_step, 1.2e-7);
  EXPECT_FALSE(plan.structure_fixed);
}

TEST(StepPlan, AFasterStructureTakesSeveralSteps) {
  const StepPlan plan = with_structure(1e-8);
  EXPECT_EQ(plan.impactor_steps, 1U);
  EXPECT_EQ(plan.structure_steps, 3U);
  EXPECT_DOUBLE_EQ(plan.structure_step, 0.8e-8);
}

constexpr SideSteps no_limit{.stable = std::numeric_limits<double>::max(),
                             .preferred = std::numeric_limits<double>::max()};

StepPlan following(const scene::Scene& scene, SideSteps structure = {.stable = 1e-7, .preferred = 0.9e-7}) {
  return plan_steps(scene, 3e-3, no_limit, structure);
}

TEST(StepPlan, AnImpactorWithoutStepsFollowsTheStructure) {
  const StepPlan plan = following(automatic());
  EXPECT_EQ(plan.impactor_steps, 1U);
  EXPECT_EQ(plan.structure_steps, 1U);
  EXPECT_DOUBLE_EQ(plan.window, 0.9e-7);
  EXPECT_FALSE(plan.structure_fixed);
}

TEST(StepPlan, AnImpactorWithoutStepsFollowsWhatTheSceneAsksOfTheStructure) {
  scene::Scene scene = automatic();
  scene.mutable_steps()->mutable_structure()->set_seconds(0.5e-7);
  EXPECT_DOUBLE_EQ(following(scene).window, 0.5e-7);
  scene.mutable_steps()->mutable_structure()->set_ratio(3.0);
  EXPECT_EQ(following(scene).impactor_steps, 3U);
  EXPECT_DOUBLE_EQ(following(scene).structure_step, 0.9e-7);
  scene.mutable_steps()->mutable_structure()->set_ratio(0.5);
  EXPECT_EQ(following(scene).structure_steps, 2U);
  EXPECT_DOUBLE_EQ(following(scene).structure_step, 0.9e-7);
}

TEST(StepPlan, AnImpactorWithoutStepsMayBeGivenOne) {
  scene::Scene scene = automatic();
  scene.mutable_steps()->mutable_impactor()->set_seconds(2e-7);
  EXPECT_EQ(following(scene).structure_steps, 3U);
  EXPECT_DOUBLE_EQ(following(scene).window, 2e-7);
  scene.mutable_steps()->mutable_impactor()->set_ratio(20.0);
  EXPECT_THROW(static_cast<void>(following(scene)), InputError);  // of what contact time?
}

TEST(StepPlan, WhereNeitherSideHasALimitTheRunIsDividedInAThousand) {
  const StepPlan plan = following(automatic(), no_limit);
  EXPECT_EQ(plan.windows, 1000U);
  EXPECT_DOUBLE_EQ(plan.window, 3e-6);
}

TEST(StepPlan, AWindowIsNoLongerThanHalfAContact) {
  EXPECT_EQ(with_structure(std::numeric_limits<double>::max()).impactor_steps, 5U);  // a rigid target
  EXPECT_EQ(with_structure(1e-3).structure_steps, 1U);
}

TEST(StepPlan, ExactRatiosAreNotLostToRoundOff) {
  for (unsigned n = 1; n <= 5; ++n) {
    EXPECT_EQ(with_structure(n * 2.4e-8).impactor_steps, n);
  }
  for (unsigned n = 1; n < 200; ++n) {
    const StepPlan finer = with_structure(2.4e-8 / n);
    EXPECT_EQ(finer.structure_steps, n);
    EXPECT_EQ(finer.impactor_steps, 1U);
  }
}

TEST(StepPlan, EqualPreferencesAreEqualSteps) { EXPECT_TRUE(with_structure(2.4e-8).equal_steps()); }

TEST(StepPlan, CoversTheEndWithoutATruncatedOrSpareWindow) {
  for (unsigned n = 1; n < 2000; ++n) {
    const StepPlan plan = plan_steps(automatic(), n * 2.4e-8, impactor, {2.4e-8, 2.4e-8});
    EXPECT_EQ(plan.windows, n);
  }
  EXPECT_EQ(plan_steps(automatic(), 10.5 * 2.4e-8, impactor, {2.4e-8, 2.4e-8}).windows, 11U);
}

TEST(StepPlan, HonoursWhatTheSceneFixes) {
  auto scene = automatic();
  scene.mutable_steps()->mutable_impactor()->set_ratio(20.0);
  scene.mutable_steps()->mutable_structure()->set_seconds(3.6e-8);
  const StepPlan plan = plan_steps(scene, 3e-3, impactor, {1e-7, 1e-7});
  EXPECT_DOUBLE_EQ(plan.impactor_step, 1.2e-8);
  EXPECT_EQ(plan.impactor_steps, 3U);
  EXPECT_EQ(plan.structure_steps, 1U);
  EXPECT_TRUE(plan.structure_fixed);
  scene.mutable_steps()->mutable_structure()->set_ratio(0.25);
  EXPECT_EQ(plan_steps(scene, 3e-3, impactor, {1e-7, 1e-7}).structure_steps, 4U);
}

TEST(StepPlan, RefusesUnstableStepsWithBothValues) {
  auto scene = automatic();
  scene.mutable_steps()->mutable_impactor()->set_seconds(5e-8);
  EXPECT_THAT(refusal(scene), ::testing::AllOf(HasSubstr("steps.impactor"), HasSubstr("5e-08"), HasSubstr("4e-08")));
  scene = automatic();
  scene.mutable_steps()->mutable_structure()->set_ratio(5.0);
  EXPECT_THAT(refusal(scene), HasSubstr("steps.structure: a step of 1.2e-07"));
}

TEST(StepPlan, RefusesStepsThatNeverMeetAndNamesTheNearest) {
  auto scene = automatic();
  scene.mutable_steps()->mutable_structure()->set_seconds(6e-8);
  EXPECT_THAT(refusal(scene), ::testing::AllOf(HasSubstr("2.5 times"), HasSubstr("4.8e-08"), HasSubstr("7.2e-08")));
}

TEST(StepPlan, RefusesWhatNoIntegerCounts) {
  constexpr SideSteps unlimited{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  auto scene = automatic();
  for (const double ratio : {1e12, 1e300}) {
    scene.mutable_steps()->mutable_structure()->set_ratio(ratio);
    EXPECT_THAT(refusal(scene, unlimited), HasSubstr("steps"));
  }
  scene.mutable_steps()->mutable_structure()->set_ratio(1e-12);
  EXPECT_THAT(refusal(scene), HasSubstr("1e+12 steps per window"));
  scene = automatic();
  EXPECT_THAT(refusal_until(1e300, scene), HasSubstr("time.end: would take"));
  for (const double fine : {1e30, 1e300}) {
    scene.mutable_steps()->mutable_impactor()->set_ratio(fine);
    EXPECT_THAT(refusal(scene, unlimited), HasSubstr("would take"));
  }
}

TEST(StepPlan, HeavyParticlesOnLightNodesGetEqualSteps) {
  const auto plan_of = [](const scene::Scene& scene, double structure_step) {
    SideSteps heavy = impactor;
    heavy.contact_mass = 2e-3;
    return plan_steps(scene, 3e-3, heavy,
                      {.stable = structure_step, .preferred = structure_step, .contact_mass = 1e-3});
  };
  for (const double structure_step : {1e-9, 0.7e-8, 2.4e-8, 1e-7}) {
    const StepPlan plan = plan_of(automatic(), structure_step);
    EXPECT_TRUE(plan.equal_steps());
    EXPECT_DOUBLE_EQ(plan.impactor_step, std::min(2.4e-8, 0.75 * structure_step)) << "a dent shortens it";
  }
  auto scene = automatic();
  scene.mutable_steps()->mutable_impactor()->set_ratio(20.0);  // what the scene fixes is kept
  EXPECT_DOUBLE_EQ(plan_of(scene, 0.5e-8).impactor_step, 1.2e-8);
  EXPECT_EQ(plan_of(scene, 0.5e-8).structure_steps, 3U);
  EXPECT_TRUE(plan_of(scene, 1e-7).equal_steps());
}

TEST(StepPlan, RefusesAWindowThatIsLongerThanAContact) {
  auto scene = automatic();
  scene.mutable_steps()->mutable_structure()->set_ratio(10);
  EXPECT_EQ(plan_steps(scene, 3e-3, impactor, {1e-6, 1e-6}).impactor_steps, 10U);
  scene.mutable_steps()->mutable_structure()->set_ratio(11);
  EXPECT_THAT(refusal(scene, {1e-6, 1e-6}),
              ::testing::AllOf(HasSubstr("steps.structure"), HasSubstr("2.64e-07"), HasSubstr("2.4e-07")));
}

TEST(StepPlan, AFoamHasTwoStepsInAWindowAtMost) {
  auto scene = automatic();
  SideSteps foam = impactor;
  foam.longest_window = 2.0 * foam.preferred;
  const StepPlan plan = plan_steps(scene, 3e-3, foam, {1e-6, 1e-6});
  EXPECT_EQ(plan.impactor_steps, 2U);
  EXPECT_EQ(plan.structure_steps, 1U);
  scene.mutable_steps()->mutable_structure()->set_ratio(8);  // what the scene fixes is kept
  EXPECT_EQ(plan_steps(scene, 3e-3, foam, {1e-6, 1e-6}).impactor_steps, 8U);
}

TEST(StepPlan, RefusesAWindowThatIsLongerThanTheRun) {
  constexpr SideSteps unlimited{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  auto scene = automatic();
  scene.mutable_steps()->mutable_structure()->set_ratio(4000);
  SideSteps patient = impactor;
  patient.contact_time = 1.0;
  try {
    static_cast<void>(plan_steps(scene, 9e-5, patient, unlimited));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                ::testing::AllOf(HasSubstr("steps.structure"), HasSubstr("9.6e-05"), HasSubstr("whole run of 9e-05")));
  }
}

TEST(StepPlan, TheContactTimeIsNotTenPreferredSteps) {
  scene::Scene scene = automatic();
  scene.mutable_steps()->mutable_impactor()->set_ratio(20.0);
  SideSteps damped = impactor;  // e of 0.01: the stable step is far below t_e/10
  damped.contact_time = 8e-7;
  EXPECT_DOUBLE_EQ(plan_steps(scene, 3e-3, damped, {1e-7, 1e-7}).impactor_step, 4e-8);
}

TEST(StepPlan, OutputIsSpreadOverAllWindows) {
  const StepPlan plan = with_structure(1.3e-7);
  EXPECT_EQ(plan.windows, 25000U);
  EXPECT_DOUBLE_EQ(plan.report_every, 25000.0 / 499.0);  // the first of 500 at the start, the last at the end
  EXPECT_DOUBLE_EQ(plan.snapshot_every, 25000.0 / 49.0);
  EXPECT_DOUBLE_EQ(plan.profile_every, 25000.0 / 30.0);  // means over intervals
  EXPECT_TRUE(plan.warnings.empty());
  auto scene = automatic();
  scene.mutable_output()->set_snapshots(0);
  scene.mutable_output()->set_profiles(0);
  const StepPlan none = plan_steps(scene, 3e-3, impactor, {1.3e-7, 1.3e-7});
  EXPECT_EQ(none.snapshot_every, 0.0);
  EXPECT_EQ(none.profile_every, 0.0);
}

/// As the participants and the recorder count.
struct Counts {
  unsigned rows = 0, snapshots = 0, profiles = 0;
  bool last_row = false, last_snapshot = false, last_profile = false;
};

Counts counts_of(const StepPlan& plan) {
  Counts out;
  for (std::uint64_t n = 0; n <= plan.windows; ++n) {
    const participant::Due due = participant::due_at(plan.start(), n);
    const bool profile = n != 0 && participant::falls_due(plan.profile_every, n, plan.windows);
    out.rows += due.report ? 1U : 0U;
    out.snapshots += due.snapshot ? 1U : 0U;
    out.profiles += profile ? 1U : 0U;
    out.last_row = due.report;
    out.last_snapshot = due.snapshot;
    out.last_profile = profile;
  }
  return out;
}

TEST(StepPlan, CountsAreWhatWasAskedForAndTheLastStateIsThere) {
  for (const std::uint32_t asked : {1U, 2U, 4U, 7U, 50U, 200U, 333U, 400U, 997U, 1250U}) {
    auto scene = automatic();
    scene.mutable_output()->set_snapshots(asked);
    scene.mutable_output()->set_rows(std::max(2U, asked));
    scene.mutable_output()->set_profiles(asked);
    for (const double structure : {1e-7, 1e-3}) {  // 1250 windows, and a long one that is shortened
      const StepPlan plan = plan_steps(scene, 3e-5, impactor, {structure, structure});
      const Counts found = counts_of(plan);
      EXPECT_TRUE(plan.warnings.empty()) << asked << ": " << plan.warnings.front();
      EXPECT_EQ(found.snapshots, asked);
      EXPECT_EQ(found.rows, std::max(2U, asked));
      EXPECT_EQ(found.profiles, asked);
      EXPECT_TRUE(found.last_row && found.last_snapshot && found.last_profile) << asked;
    }
  }
}

TEST(StepPlan, MoreThanThereAreWindowsIsAWarning) {
  auto scene = automatic();
  scene.mutable_output()->set_snapshots(8);
  scene.mutable_output()->set_profiles(30);
  scene.mutable_steps()->mutable_structure()->set_ratio(1);
  const StepPlan plan = plan_steps(scene, 10 * 2.4e-8, impactor, {1e-7, 1e-7});
  ASSERT_EQ(plan.windows, 10U);
  EXPECT_EQ(counts_of(plan).rows, 11U);
  EXPECT_EQ(counts_of(plan).snapshots, 8U);
  EXPECT_EQ(counts_of(plan).profiles, 10U);
  EXPECT_THAT(plan.warnings,
              ::testing::ElementsAre(HasSubstr("output.rows: 500 were asked for, but the run has only 10 "
                                               "windows"),
                                     HasSubstr("output.profiles: 30 were asked for")));
}

}  // namespace
}  // namespace grainstep::orchestrator
