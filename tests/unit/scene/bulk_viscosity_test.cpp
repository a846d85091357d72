#include "scene/bulk_viscosity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "declare/write.hpp"
#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

/// The reference beam under a history; h/8 of steel: ten elements are 5.4 us.
Scene pressed(const std::string& history, const std::vector<std::string>& overrides = {}) {
  const std::string& scene = minimal_scene;
  const auto from = scene.find("impactor:");
  return load_text(scene.substr(0, from) + "impactor: {type: pressure, pressure: {" + history + "}}\n" +
                       scene.substr(scene.find("structure:")),
                   overrides);
}

TEST(BulkViscosity, IsOffUnlessAskedFor) {
  const Scene scene = load_text(minimal_scene);
  EXPECT_TRUE(scene.structure().bulk_viscosity().has_linear());  // so that the resolved scene shows it
  EXPECT_EQ(scene.structure().bulk_viscosity().linear(), 0.0);
  EXPECT_EQ(scene.structure().bulk_viscosity().quadratic(), 0.0);
  EXPECT_THAT(declare::to_yaml(scene), testing::HasSubstr("bulk_viscosity:"));
}

TEST(BulkViscosity, AStepAboveTheYieldStrengthStrikesSuddenly) {
  EXPECT_FALSE(strikes_suddenly(load_text(minimal_scene)));
  EXPECT_FALSE(strikes_suddenly(pressed("rectangular: {pressure: 400 MPa}")));
  EXPECT_TRUE(strikes_suddenly(pressed("rectangular: {pressure: 500 MPa}")));
  EXPECT_TRUE(strikes_suddenly(pressed("rectangular: {pressure: -500 MPa}")));
  EXPECT_TRUE(strikes_suddenly(pressed("exponential: {peak: 500 MPa, decay_time: 1 ms}")));
  EXPECT_FALSE(
      strikes_suddenly(pressed("rectangular: {pressure: 500 MPa}", {"structure.layers.0.yield_strength=600 MPa"})));
  EXPECT_FALSE(strikes_suddenly(
      pressed("rectangular: {pressure: 5 GPa}", {"structure.layers.0.material=elastic", "time.end=1 ms"})));
  EXPECT_FALSE(strikes_suddenly(pressed("rectangular: {pressure: 5 GPa}", {"structure.type=rigid"})));
}

TEST(BulkViscosity, ATableStrikesByItsSteepestPart) {
  const auto ramp = [](const std::string& times, const std::string& pressures) {
    return pressed("tabulated: {time: [" + times + "], pressure: [" + pressures + "]}");
  };
  EXPECT_TRUE(strikes_suddenly(ramp("0 us, 100 us", "1 GPa, 1 GPa")));  // begins and ends with a jump
  EXPECT_TRUE(strikes_suddenly(ramp("0 us, 2 us, 100 us", "0 Pa, 1 GPa, 0 Pa")));
  EXPECT_TRUE(strikes_suddenly(ramp("0 us, 98 us, 100 us", "0 Pa, 1 GPa, 0 Pa")));  // falls suddenly
  EXPECT_FALSE(strikes_suddenly(ramp("0 us, 50 us, 100 us", "0 Pa, 1 GPa, 0 Pa")));
}

TEST(BulkViscosity, RingingIsToldBeforeTheRun) {
  const auto findings = check_rules(pressed("rectangular: {pressure: 1.6 GPa}"));
  ASSERT_EQ(findings.size(), 1);
  EXPECT_EQ(findings[0].severity, Severity::warning);
  EXPECT_EQ(findings[0].path, "impactor.pressure");
  EXPECT_THAT(findings[0].text, testing::HasSubstr("structure.bulk_viscosity"));
  EXPECT_TRUE(check_rules(pressed("rectangular: {pressure: 86.4 MPa}")).empty());
  EXPECT_TRUE(
      check_rules(pressed("rectangular: {pressure: 1.6 GPa}", {"structure.bulk_viscosity.linear=0.06"})).empty());
}

}  // namespace
}  // namespace grainstep::scene
