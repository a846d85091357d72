#include "scene/rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

TEST(Rules, TheReferenceSceneKeepsThem) { EXPECT_TRUE(check_rules(load_text(minimal_scene)).empty()); }

TEST(Rules, AParticleFitsIntoTheSlug) {
  EXPECT_EQ(
      load_error(replaced(minimal_scene, "200 um", "0.21 m")),
      "x.yaml:9: impactor.slug.particle.diameter: a particle of 0.21 m does not fit into a slug of 0.2 m by 0.3 m");
}

TEST(Rules, StepsMeet) {
  EXPECT_EQ(load_error(minimal_scene, {"steps.structure=2.5"}),
            "--set: steps.structure: a ratio of 2.5 to the impactor's step: the two sides would never meet; expected a "
            "whole number or one over a whole number");
  EXPECT_EQ(
      load_error(minimal_scene, {"steps.structure=30 ns", "steps.impactor=20 ns"}),
      "--set: steps.structure: is 1.5 times the impactor's step: the two sides would never meet; expected a whole "
      "number of steps of one in a step of the other");
  for (const auto* const ratio : {"1", "3", "0.5", "0.3333333"}) {
    EXPECT_EQ(load_error(minimal_scene, {std::string("steps.structure=") + ratio}), "accepted") << ratio;
  }
  EXPECT_EQ(load_error(minimal_scene, {"steps.structure=60 ns", "steps.impactor=20 ns"}), "accepted");
}

TEST(Rules, AStepFitsIntoTheRun) {
  EXPECT_EQ(load_error(minimal_scene, {"time.end=1 ms", "steps.impactor=2 ms"}),
            "--set: steps.impactor: a step of 0.002 s is longer than the whole run (time.end is 0.001 s)");
}

TEST(Rules, WarningsDoNotStopARun) {
  const auto findings =
      check_rules(load_text(minimal_scene, {"impactor.slug.half_width=0.6", "impactor.slug.speed=0"}));
  ASSERT_EQ(findings.size(), 2);
  EXPECT_EQ(findings[0].severity, Severity::warning);
  EXPECT_EQ(findings[0].path, "impactor.slug.half_width");
  EXPECT_EQ(findings[1].path, "impactor.slug.speed");
}

// The share by hand: the part of the slug's width that lies beyond the end of the span.
TEST(Rules, ASlugPartlyBesideTheStructureIsTold) {
  const auto told = [&](std::vector<std::string> overrides) {
    overrides.emplace_back("structure.extent=full");
    const auto findings = check_rules(load_text(minimal_scene, overrides));
    EXPECT_LE(findings.size(), 1);
    return findings.empty() ? std::string() : findings[0].path + ": " + findings[0].text;
  };
  EXPECT_EQ(told({"impactor.slug.offset=0.5 m"}),
            "impactor.slug.offset: about 50% of the slug (half width 0.1 m) flies past the structure "
            "(structure.half_span is 0.5 m) and loads nothing");
  EXPECT_THAT(told({"impactor.slug.offset=-0.45 m"}), testing::HasSubstr("about 25% of the slug"));
  EXPECT_EQ(told({"impactor.slug.offset=0.4 m"}), "");
  EXPECT_THAT(told({"impactor.slug.half_width=1 m"}), testing::StartsWith("impactor.slug.half_width: about 50% of"));
  EXPECT_EQ(told({"impactor.slug.angle=45 deg"}), "");
  // 0.8 m further on, and 0.1 m because the lower edge touches first: from 0.76 m to 1.04 m on a span that ends at 0.5
  // m.
  EXPECT_THAT(told({"impactor.slug.angle=45 deg", "impactor.slug.stand_off=0.8 m"}),
              testing::StartsWith("impactor.slug.angle: about 100% of"));
}

TEST(Rules, AContactTooSoftIsToldBeforeTheRun) {
  const auto findings = check_rules(load_text(minimal_scene, {"impactor.slug.particle.normal_stiffness=73 kN/m"}));
  ASSERT_EQ(findings.size(), 1);
  EXPECT_EQ(findings[0].severity, Severity::warning);
  EXPECT_EQ(findings[0].path, "impactor.slug.particle.normal_stiffness");
}

TEST(Rules, AHoleAtTheAxisIsToldBeforeTheRun) {
  const auto plate = std::filesystem::path(GRAINSTEP_SOURCE_DIR) / "configs/small/plate-monolithic.yaml";
  EXPECT_TRUE(check_rules(load_scene(plate)).empty());
  const std::vector<std::string> narrow = {"impactor.slug.slice_angle=5 deg"};
  const auto findings = check_rules(load_scene(plate, narrow));
  ASSERT_EQ(findings.size(), 1);
  EXPECT_EQ(findings[0].severity, Severity::warning);
  EXPECT_EQ(findings[0].path, "impactor.slug.slice_angle");
  EXPECT_THAT(findings[0].text, testing::HasSubstr("0.229256 of the slug's radius"));
}

TEST(Rules, ASlugArrivesBeforeTheEnd) {
  EXPECT_EQ(
      load_error(minimal_scene, {"time.end=1 ms", "impactor.slug.stand_off=1 m"}),
      "--set: impactor.slug.stand_off: found 1 m: the slug would arrive after 0.0025 s, but the run ends at 0.001 "
      "s; expected a smaller gap or a later time.end");
  EXPECT_EQ(load_error(minimal_scene, {"time.end=1 ms", "impactor.slug.stand_off=1 mm"}), "accepted");
}

}  // namespace
}  // namespace grainstep::scene
