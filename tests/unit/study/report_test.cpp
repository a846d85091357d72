#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "orchestrator/study/page.hpp"
#include "study_files.hpp"

namespace grainstep::study {
namespace {

using ::testing::HasSubstr;

const std::string text = R"yaml(reference: [seeds/seed=2]
series:
  - { name: seeds, axes: [{ key: impactor.slug.seed, values: [1, 2, 3] }] }
  - { name: bad, set: ["impactor.slug.seed=8"] }
  - { name: far, set: ["impactor.slug.seed=9"], long: true }
columns:
  - { name: seed, value: impactor.slug.seed }
  - { name: peak_deflection }
  - { name: early_pressure, title: "p, early|late" }
  - { name: error, unit: "%", value: "100 * (peak_deflection / in(reference, peak_deflection) - 1)"
}
findings:
  - { statement: mean, on: seeds, value: mean(peak_deflection), expected: 0.2, tolerance: 0.01, source: figure 4 }
  - { statement: too small, on: seeds/seed=1, value: peak_deflection, at_least: 0.15 }
  - { statement: told, on: seeds, value: max(error) }
  - { statement: no pressure, on: seeds/seed=1, value: early_pressure, at_most: 9 }
  - { statement: later, on: far, value: peak_deflection, at_least: 0 }
  - { statement: never, on: bad, value: impactor.slug.seed, at_least: 0 }
  - { statement: just near, on: seeds/seed=1, value: peak_deflection, expected: 0.1009, tolerance: 0.01 }
  - { statement: just off, on: seeds/seed=1, value: peak_deflection, expected: 0.1011, tolerance: 0.01 }
  - { statement: off from nothing, on: seeds/seed=1, value: peak_deflection, expected: 0, tolerance: 0.09 }
series_columns:
  - { name: w, title: mean of w, value: mean(peak_deflection) }
  - { name: scatter, value: deviation(peak_deflection), hidden: true }
plots:
  - { x: seed, y: peak_deflection, log_x: true, marks: [{ x: 1, y: 2, label: m }], levels: [{ y: 0.2 }] }
  - { name: means, kind: series, x: mean(seed), y: max(peak_deflection) }
snapshots:
  - { name: two, title: of two, on: seeds/seed=2, times: [0.1, 1.0] }
  - { name: later, on: far, times: [0.5] }
)yaml";

class ReportTest : public ::testing::Test {
 protected:
  ReportTest() {
    const double peaks[] = {0.1, 0.2, 0.3};
    for (std::size_t i = 0; i < 3; ++i) {
      files_.leave_run("out/" + plan_.points[i].directory.string(), plan_.points[i].key, "done", 0, peaks[i]);
    }
    files_.leave_run("out/runs/bad", plan_.points[3].key, "failed", 3);
    outcomes_ = locate(plan_, files_.folder() / "out", {});
    outcomes_[4].state = Outcome::State::postponed;
    numbers_.emplace(plan_, outcomes_);
    numbers_->compute_columns();
    verdicts_ = judge(plan_, outcomes_, *numbers_);
  }
  [[nodiscard]] Report report() const { return {plan_, outcomes_, *numbers_, verdicts_}; }

  StudyFiles files_;
  Plan plan_ = files_.plan(text);
  std::vector<Outcome> outcomes_;
  std::optional<Numbers> numbers_;
  std::vector<Verdict> verdicts_;
};

TEST_F(ReportTest, ColumnsAreNumbersOfRunsAndFormulasOverThem) {
  EXPECT_EQ(numbers_->column(2, "seed"), 3);
  EXPECT_NEAR(numbers_->column(2, "error"), 50.0, 1e-12);
  EXPECT_EQ(numbers_->column(1, "error"), 0.0);
  EXPECT_TRUE(std::isnan(numbers_->column(0, "early_pressure")));
  EXPECT_TRUE(std::isnan(numbers_->column(4, "peak_deflection")));
}

TEST_F(ReportTest, FindingsHoldFailOrWait) {
  using State = Verdict::State;
  const std::vector<State> expected = {State::holds, State::fails, State::reported, State::fails, State::open,
                                       State::fails, State::holds, State::fails,    State::fails};
  ASSERT_EQ(verdicts_.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(verdicts_[i].state, expected[i]) << i;
  EXPECT_NEAR(verdicts_[0].value, 0.2, 1e-15);
  EXPECT_EQ(verdicts_[0].wanted, "0.2 +- 1%");
  EXPECT_NEAR(verdicts_[2].value, 50.0, 1e-12);
}

TEST_F(ReportTest, TheTableHasEveryPoint) {
  const std::string table = table_csv(report(), files_.folder() / "out");
  EXPECT_THAT(table, HasSubstr("series,point,status,seed,peak_deflection,early_pressure,error,set,directory,reason\n"));
  EXPECT_THAT(table, HasSubstr("seeds,seed=1,done,1,0.1,,-50,impactor.slug.seed=1,runs/seeds/seed=1,\n"));
  EXPECT_THAT(table, HasSubstr("bad,bad,failed,,,,,impactor.slug.seed=8,runs/bad,because\n"));
  EXPECT_THAT(table, HasSubstr("far,far,long,,,,,"));
}

TEST_F(ReportTest, CurvesHoldFinishedRunsOnly) {
  EXPECT_EQ(curves_csv(report(), plan_.study.plots(0)),
            "curve,point,x,y\nseeds,seed=1,1,0.1\nseeds,seed=2,2,0.2\nseeds,seed=3,3,0.3\n");
}

TEST_F(ReportTest, SeriesHaveATableAndMarkersOfTheirOwn) {
  const std::string table = series_csv(report());
  EXPECT_THAT(table, HasSubstr("series,done,w,scatter\nseeds,3,"));
  EXPECT_THAT(table, HasSubstr("bad,0,,\nfar,0,,\n"));
  EXPECT_EQ(curves_csv(report(), plan_.study.plots(1)), "curve,point,x,y\nseeds,seeds,2,0.3\n");
}

TEST_F(ReportTest, TheJsonSaysHowToDraw) {
  const auto json = nlohmann::json::parse(study_json(report(), files_.folder() / "out"));
  EXPECT_EQ(json["points"][0]["values"]["peak_deflection"], 0.1);
  EXPECT_EQ(json["points"][0]["values"]["early_pressure"], nullptr);
  EXPECT_EQ(json["plots"][0]["title"], "T");
  EXPECT_EQ(json["plots"][0]["y_label"], "peak_deflection");
  EXPECT_EQ(json["plots"][0]["marks"][0]["label"], "m");
  EXPECT_EQ(json["plots"][0]["levels"][0]["axis"], "y");
  EXPECT_EQ(json["snapshots"][0]["directory"], "runs/seeds/seed=2");
  EXPECT_EQ(json["snapshots"][0]["times"], (std::vector<double>{0.1, 1.0}));
  EXPECT_EQ(json["snapshots"][1]["directory"], nullptr);
  EXPECT_EQ(json["findings"][1]["verdict"], "FAILS");
}

TEST_F(ReportTest, ThePageSaysWhatIsStatedAndWhatCameOut) {
  const std::string page = page_markdown(report(), "grainstep study x.yaml",
                                         [](const std::string& name) { return "images/" + name + ".png"; });
  EXPECT_THAT(page, HasSubstr("# T\n"));
  EXPECT_THAT(page, HasSubstr("![T](images/plot.png)"));
  EXPECT_THAT(page, HasSubstr("![of two](images/two.png)"));
  EXPECT_THAT(page, HasSubstr("| mean | figure 4 | 0.2 +- 1% | 0.2 | "));
  EXPECT_THAT(page, HasSubstr("| too small |  | at least 0.15 | 0.1 |  | **does not hold** |"));
  EXPECT_THAT(page, HasSubstr("| told | seeds | 50 |"));
  EXPECT_THAT(page, HasSubstr("| series | runs | mean of w |\n|---|---|---|\n| seeds | 3 | 0.2 |\n| bad | 0 | - |"));
  EXPECT_THAT(page, HasSubstr("| p, early\\|late |"));
  EXPECT_THAT(page, HasSubstr("far (needs --long, not run)"));
  EXPECT_THAT(page, HasSubstr("bad (failed: because)"));
  EXPECT_THAT(page, HasSubstr("Made by `grainstep study x.yaml`: 3 runs, "));
}

}  // namespace
}  // namespace grainstep::study
