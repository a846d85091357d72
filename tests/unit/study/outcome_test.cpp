#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_files.hpp"

namespace grainstep::study {
namespace {

using State = Outcome::State;

const std::string two_series = R"(series:
  - { name: a, set: ["impactor.slug.seed=1"] }
  - { name: b, set: ["impactor.slug.seed=2"] }
)";

class OutcomeTest : public ::testing::Test {
 protected:
  std::vector<Outcome> locate_all(const std::vector<std::filesystem::path>& reuse = {}) {
    return locate(plan_, root(), reuse);
  }
  [[nodiscard]] std::filesystem::path root() const { return files_.folder() / "out"; }
  StudyFiles files_;
  Plan plan_ = files_.plan(two_series);
};

TEST_F(OutcomeTest, NothingIsThereAtFirst) {
  for (const Outcome& outcome : locate_all()) EXPECT_EQ(outcome.state, State::open);
  EXPECT_EQ(locate_all()[1].directory, root() / "runs" / "b");
}

TEST_F(OutcomeTest, AFinishedRunOfTheSameSceneIsTaken) {
  files_.leave_run("out/runs/a", plan_.points[0].key);
  const auto found = locate_all();
  EXPECT_EQ(found[0].state, State::done);
  EXPECT_EQ(found[0].summary["peak_deflection"], 0.1);
  EXPECT_FALSE(found[0].computed);
  EXPECT_EQ(found[1].state, State::open);
}

TEST_F(OutcomeTest, OtherScenesVersionsAndEndsAreNot) {
  files_.leave_run("out/runs/a", "0123456789abcdef");
  EXPECT_EQ(locate_all()[0].state, State::open);
  files_.leave_run("out/runs/a", plan_.points[0].key, "done", 0, 0.1, orchestrator::results_version + 1);
  EXPECT_EQ(locate_all()[0].state, State::open);
  files_.leave_run("out/runs/a", plan_.points[0].key, "interrupted", 130);
  EXPECT_EQ(locate_all()[0].state, State::open);
  files_.leave_run("out/runs/a", plan_.points[0].key, "failed", 4);
  EXPECT_EQ(locate_all()[0].state, State::open);
  files_.write("out/runs/a/summary.json", "{ half a");
  EXPECT_EQ(locate_all()[0].state, State::open);
}

TEST_F(OutcomeTest, ANumericalFailureIsAResult) {
  files_.leave_run("out/runs/a", plan_.points[0].key, "failed", 3);
  const auto found = locate_all();
  EXPECT_EQ(found[0].state, State::failed);
  EXPECT_EQ(found[0].exit_code, 3);
  EXPECT_EQ(found[0].reason, "because");
}

TEST_F(OutcomeTest, RenamedPointsAndOtherStudiesRunsAreFound) {
  files_.leave_run("out/runs/old/name", plan_.points[0].key);
  files_.leave_run("elsewhere/runs/x/y", plan_.points[1].key);
  const auto found = locate_all({files_.folder() / "elsewhere"});
  EXPECT_EQ(found[0].state, State::done);
  EXPECT_EQ(found[0].directory, root() / "runs/old/name");
  EXPECT_EQ(found[1].state, State::done);
  EXPECT_EQ(found[1].directory, files_.folder() / "elsewhere/runs/x/y");
}

TEST_F(OutcomeTest, ARunThatAnotherPointNeedsIsNotOverwritten) {
  files_.leave_run("out/runs/a", plan_.points[1].key);  // the names were exchanged
  const auto found = locate_all();
  EXPECT_EQ(found[1].state, State::done);
  EXPECT_EQ(found[1].directory, root() / "runs/a");
  EXPECT_EQ(found[0].state, State::open);
  EXPECT_EQ(found[0].directory, root() / "runs/a-2");
}

}  // namespace
}  // namespace grainstep::study
