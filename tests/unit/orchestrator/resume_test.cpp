// What must be the same for a run to go on, and when checkpoints are asked for.
#include "orchestrator/record/resume.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "base/error.hpp"
#include "orchestrator/process/interrupted.hpp"
#include "orchestrator/process/save_schedule.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

About about() {
  About out{.scene_hash = 7, .plan = {}, .impactor = "grains (avx2)", .structure = "fe (avx2)", .ranks = 1};
  out.plan.window = 1.25e-7;
  out.plan.windows = 1000;
  return out;
}

std::string difference(const std::function<void(About&)>& change, bool inexact) {
  Resume resume;
  resume.about = text_of(about());
  About now = about();
  change(now);
  try {
    require_same(resume, now, inexact);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Resume, GoesOnWithTheSame) {
  EXPECT_EQ(difference([](About&) {}, false), "");
}

TEST(Resume, AnotherSceneOrOtherStepsAreRefusedWhateverIsSaid) {
  const std::pair<std::function<void(About&)>, const char*> cases[] = {
      {[](About& a) { a.scene_hash = 8; }, "the checkpoint is of scene 7, this run of 8"},
      {[](About& a) { a.plan.window = 1.250000000000001e-7; }, "of window "},
      {[](About& a) { a.plan.windows = 999; }, "of windows 1000, this run of 999"},
      {[](About& a) { a.plan.impactor_steps = 3; }, "of impactor_steps 1, this run of 3"},
      {[](About& a) { a.plan.structure_steps = 3; }, "of structure_steps 1, this run of 3"}};
  for (const auto& [change, told] : cases) {
    EXPECT_THAT(difference(change, false), HasSubstr(told));
    EXPECT_THAT(difference(change, true), HasSubstr(told));
  }
}

TEST(Resume, AnotherBuildIsRefusedUnlessTheSameBitsAreNotNeeded) {
  const std::pair<std::function<void(About&)>, const char*> cases[] = {
      {[](About& a) { a.impactor = "grains (baseline)"; }, "of impactor \"grains (avx2)\""},
      {[](About& a) { a.structure = "fe (baseline)"; }, "of structure \"fe (avx2)\""},
      {[](About& a) { a.ranks = 2; }, "of ranks 1, this run of 2"}};
  for (const auto& [change, told] : cases) {
    EXPECT_THAT(difference(change, false), HasSubstr(told));
    EXPECT_THAT(difference(change, false), HasSubstr("--inexact goes on all the same, but not bit for bit"));
    EXPECT_EQ(difference(change, true), "");
  }
  for (const char* key : {"version", "commit", "isa"}) {
    EXPECT_THAT(text_of(about()), HasSubstr(std::string("\"") + key + "\": "));
  }
}

TEST(SaveSchedule, WithoutATimeOnlyWhatIsAskedFor) {
  SaveSchedule schedule(0.0);
  EXPECT_FALSE(schedule.due(1));
  schedule.save_now();
  EXPECT_TRUE(schedule.due(1));
  EXPECT_FALSE(schedule.due(1));
}

TEST(SaveSchedule, EverySoManySeconds) {
  SaveSchedule often(1e-9);
  EXPECT_TRUE(often.due(1));
  EXPECT_TRUE(often.due(1));
  SaveSchedule seldom(1e9);
  EXPECT_FALSE(seldom.due(1));
}

TEST(SaveSchedule, SpreadOverTheWindowsOfARun) {
  const auto saved = [](std::uint64_t done) {
    SaveSchedule schedule(0.0);
    schedule.spread(3, 100, done);
    std::vector<std::uint64_t> windows;
    for (std::uint64_t window = done + 1; window <= 100; ++window) {
      if (schedule.due(window)) windows.push_back(window);
    }
    return windows;
  };
  EXPECT_THAT(saved(0), testing::ElementsAre(25, 50, 75, 100));
  EXPECT_THAT(saved(50), testing::ElementsAre(75, 100)) << "a run that goes on";
}

TEST(SaveSchedule, SeveralMarksThatPassUnaskedAreOneCheckpoint) {
  SaveSchedule schedule(0.0);
  schedule.spread(9, 100, 0);
  EXPECT_FALSE(schedule.due(9));
  EXPECT_TRUE(schedule.due(37));
  EXPECT_FALSE(schedule.due(39));
  EXPECT_TRUE(schedule.due(40));
}

TEST(SaveSchedule, AnEndFromOutsideWaitsForOneMoreCheckpoint) {
  SaveSchedule schedule(0.0);
  schedule.written();
  schedule.end_after_next();
  EXPECT_TRUE(schedule.due(1));
  EXPECT_FALSE(schedule.due(1)) << "asked once";
  schedule.written();
  EXPECT_THROW(static_cast<void>(schedule.due(1)), Interrupted);
}

}  // namespace
}  // namespace grainstep::orchestrator
