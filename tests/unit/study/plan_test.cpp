#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/usual.hpp"
#include "study_files.hpp"

namespace grainstep::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> ids(const Plan& plan) {
  std::vector<std::string> out;
  for (const PlannedPoint& point : plan.points) out.push_back(point.id);
  return out;
}

TEST(Plan, PointsThenTheProductOfTheAxes) {
  const StudyFiles files;
  const Plan plan = files.plan(R"(set: ["impactor.slug.seed=3"]
series:
  - name: grid
    set: ["impactor.slug.seed=4"]
    points: [{ name: extra, set: ["impactor.slug.seed=5"] }]
    axes:
      - { key: impactor.slug.speed, values: [100 m/s, 200 m/s] }
      - choices: [{ name: coarse, set: ["structure.mesh.refinement=1"] }, { name: fine, set: ["structure.mesh.refinement=3"], long: true }]
  - name: alone
)");
  EXPECT_THAT(ids(plan), ElementsAre("grid/extra", "grid/speed=100 m/s, coarse", "grid/speed=100 m/s, fine",
                                     "grid/speed=200 m/s, coarse", "grid/speed=200 m/s, fine", "alone"));
  EXPECT_EQ(plan.points[0].preparation.scene.impactor().slug().seed(), 5);
  EXPECT_EQ(plan.points[1].preparation.scene.impactor().slug().seed(), 4);
  EXPECT_EQ(plan.points[5].preparation.scene.impactor().slug().seed(), 3);
  EXPECT_EQ(plan.points[4].preparation.scene.impactor().slug().speed(), 200);
  EXPECT_EQ(plan.points[4].preparation.scene.structure().mesh().refinement(), 3);
  EXPECT_TRUE(plan.points[4].is_long);
  EXPECT_FALSE(plan.points[3].is_long);
  EXPECT_EQ(plan.points[4].directory, "runs/grid/speed=200-m-s-fine");
  EXPECT_EQ(plan.points[5].directory, "runs/alone");
  EXPECT_THAT(plan.points[3].set, ElementsAre("impactor.slug.seed=3", "impactor.slug.seed=4",
                                              "impactor.slug.speed=200 m/s", "structure.mesh.refinement=1"));
  EXPECT_GT(plan.points[4].estimate, plan.points[3].estimate);
}

TEST(Plan, FullFidelityAddsOverrides) {
  const StudyFiles files;
  const std::string text = R"(title: T
scene: scene.yaml
full: ["structure.mesh.refinement=4"]
series:
  - { name: a }
  - { name: b, full: ["structure.mesh.refinement=3"] }
  - { name: c, set: ["structure.mesh.refinement=1"] }
)";
  const auto meshes = [&](Fidelity fidelity) {
    std::vector<double> out;
    for (const PlannedPoint& point : load_plan(files.write("study.yaml", text), fidelity).points)
      out.push_back(point.preparation.scene.structure().mesh().refinement());
    return out;
  };
  EXPECT_THAT(meshes(Fidelity::recommended), ElementsAre(2, 2, 1));
  EXPECT_THAT(meshes(Fidelity::full), ElementsAre(4, 3, 1));
}

TEST(Plan, ScenesAreRelativeToTheFileThatNamesThem) {
  const StudyFiles files;
  files.write("deep/other.yaml", "include: ../scene.yaml\nimpactor: { slug: { seed: 9 } }\n");
  files.write("deep/base.yaml", "title: T\nscene: other.yaml\nseries: [{ name: a }]\n");
  const Plan plan = load_plan(files.write("study.yaml", "include: deep/base.yaml\n"));
  EXPECT_EQ(plan.points[0].preparation.scene.impactor().slug().seed(), 9);
}

TEST(Plan, TheSameSceneHasTheSameKey) {
  const StudyFiles files;
  const Plan plan = files.plan(R"(series:
  - { name: a, set: ["impactor.slug.seed=1"] }
  - { name: b, set: ["title=other"] }
  - { name: c, set: ["impactor.slug.seed=2"] }
)");
  EXPECT_EQ(plan.points[0].key, plan.points[1].key);
  EXPECT_NE(plan.points[0].key, plan.points[2].key);
}

TEST(Plan, DirectoriesReadLikeNames) {
  EXPECT_EQ(slug("D = 2 mm, h/4"), "D=2-mm-h-4");
  EXPECT_EQ(slug("I_o = 0.67"), "I_o=0.67");
  EXPECT_EQ(slug("../../etc"), "etc");
  EXPECT_EQ(slug("  ?!"), "");
}

TEST(Plan, BadInputNamesFileAndLine) {
  const StudyFiles files;
  EXPECT_THAT(files.error("series:\n  - name: a\n    set:\n      - impactor.slug.sped=1\n"),
              HasSubstr("study.yaml:6: impactor.slug.sped: unknown key; did you mean 'speed'?"));
  EXPECT_THAT(
      files.error(
          "series:\n  - name: a\n    axes:\n      - key: impactor.slug.speed\n        values: [100 m/s, 3 kg]\n"),
      HasSubstr("study.yaml:7: impactor.slug.speed: '3 kg'"));
  EXPECT_THAT(files.error("series:\n  - name: a\n    poinst: []\n"),
              HasSubstr("study.yaml:5: series.0.poinst: unknown key; did you mean 'points'?"));
  EXPECT_THAT(files.error("series:\n  - name: a b\n  - name: a-b\n"),
              HasSubstr("study.yaml:5: series.1.name: a second series of the name 'a-b'"));
  EXPECT_THAT(files.error("series:\n  - name: a\n    points: [{name: p}, {name: p}]\n"),
              HasSubstr("a second point of the name 'p'"));
  EXPECT_THAT(files.error("series:\n  - name: a\n    scene: none.yaml\n"),
              HasSubstr("study.yaml:5: series.0.scene: cannot read 'none.yaml'"));
  EXPECT_THAT(files.error("series:\n  - name: a\n    axes: [{ values: [1] }]\n"),
              HasSubstr("expected either `key` and `values`, or `choices`"));
  EXPECT_THAT(files.error("series:\n  - name: a\n    set: [\"steps.structure=0.01 ms\"]\n"),
              HasSubstr("point 'a': steps.structure:"));
}

TEST(Plan, OneSlipIsToldOnce) {
  const StudyFiles files;
  const std::string error = files.error("set: [\"impactor.slug.sped=1\"]\nseries: [{ name: a }, { name: b }]\n");
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0) << error;
}

TEST(Plan, ExpressionsAreCheckedBeforeAnythingRuns) {
  const StudyFiles files;
  const std::string a = "series: [{ name: a }]\n";
  EXPECT_THAT(files.error(a + "columns:\n  - { name: w, value: peak_deflexion }\n"),
              HasSubstr("study.yaml:5: columns.0.value: 'peak_deflexion' is no column above, no key of summary.json"));
  EXPECT_THAT(files.error(a + "columns:\n  - { name: w, value: \"in(b, peak_deflection)\" }\n"),
              HasSubstr("'b' is neither a series nor a point"));
  EXPECT_THAT(files.error(a + "columns: [{ name: peak_deflection }, { name: peak_deflection }]\n"),
              HasSubstr("a second column"));
  EXPECT_THAT(files.error(a + "reference: [c]\n"), HasSubstr("'c' is not a point of this study"));
  EXPECT_THAT(files.error(a + "plots: [{ x: 1 +, y: 1 }]\n"), HasSubstr("plots.0.x: '1 +': expected a number"));
  EXPECT_THAT(files.error(a + "plots: [{ x: 1, y: 1 }, { x: 1, y: 1 }]\n"), HasSubstr("'plot' is taken"));
  EXPECT_THAT(files.error(a + "snapshots: [{ name: table, on: a, times: [1] }]\n"), HasSubstr("'table' is taken"));
  EXPECT_THAT(files.error(a + "snapshots: [{ name: x, on: b, times: [1] }]\n"), HasSubstr("'b' is not a point"));
  EXPECT_THAT(files.error(a + "set: [output.snapshots=0]\nsnapshots: [{ name: x, on: a, times: [1] }]\n"),
              HasSubstr("'a' records no snapshots"));
  EXPECT_THAT(files.error(a + "plots: [{ name: ../x, x: 1, y: 1 }]\n"), HasSubstr("cannot be the name of a file"));
  EXPECT_THAT(files.error(a + "findings: [{ statement: s, on: a, value: 1, expected: 1 }]\n"),
              HasSubstr("`expected` and `tolerance` go together"));
  EXPECT_EQ(
      files.error(a + "columns:\n  - { name: v, value: impactor.slug.speed * wall_split.impactor_wait / time.end }\n"
                      "  - { name: w, value: last(series.t_bar) + v + structure.layers.0.thickness }\n"),
      "accepted");
}

TEST(Plan, ThoseOfTheRepositoryLoad) {
  namespace fs = std::filesystem;
  int found = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(GRAINSTEP_SOURCE_DIR) / "configs" / "studies")) {
    if (entry.path().extension() != ".yaml") continue;
    for (const PlannedPoint& point : load_plan(entry.path()).points) {
      std::vector<scene::Finding> findings;
      scene::check_usual(point.preparation.scene, findings);
      for (const auto& finding : findings) ADD_FAILURE() << entry.path() << ", " << point.id << ": " << finding.text;
    }
    ++found;
  }
  EXPECT_GE(found, 1);
}

}  // namespace
}  // namespace grainstep::study
