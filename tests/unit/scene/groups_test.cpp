/// @file The groups against the numbers that the paper prints, to the digits it prints.
#include "scene/groups.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

TEST(Groups, ReferenceBeam) {
  const Groups g = groups(load_text(minimal_scene));
  EXPECT_NEAR(g.reference_time, 2.063e-3, 0.0005e-3);  // section 3: t_bar = 1
  EXPECT_NEAR(g.impulse_number, 0.67, 0.005);          // I_o at 400 m/s
  EXPECT_DOUBLE_EQ(g.areal_mass, 400);
  EXPECT_DOUBLE_EQ(g.areal_momentum, 0.2 * 2700 * 0.3 * 400);
  EXPECT_NEAR(g.areal_mass_ratio, 0.405, 0.0005);
  EXPECT_DOUBLE_EQ(g.width_ratio, 0.2);
  EXPECT_DOUBLE_EQ(g.slug_time, 0.75e-3);
  EXPECT_NEAR(g.loading_time_ratio, 0.5 * 0.75 / 2.063, 1e-4);
  EXPECT_DOUBLE_EQ(g.slug_pressure, 0.2 * 2700 * 400 * 400);
  EXPECT_DOUBLE_EQ(g.end, 1.5 * g.reference_time);
}

TEST(Groups, ReferencePlate) {
  // Geometry as stated in millimetres: H = 150 mm on 20 mm of steel gives m_bar = 0.506; 0.405 would need H = 120 mm.
  EXPECT_NEAR(areal_mass_ratio(0.2, 2700, 0.15, 160), 0.506, 0.0005);
  EXPECT_NEAR(areal_mass_ratio(0.2, 2700, 0.12, 160), 0.405, 0.0005);
}

TEST(Groups, LayersAddUpAndTheFirstOneNamesTheMaterial) {
  const Groups g = groups(
      load_text(minimal_scene, {"structure.layers=[{material: dh36, thickness: 16.6667 mm, yield_strength: 400 MPa},"
                                "{material: elastic, thickness: 55 mm, density: 2424.24, yield_strength: 1 MPa},"
                                "{material: dh36, thickness: 16.6667 mm}]"}));
  EXPECT_NEAR(g.areal_mass, 400, 0.001);
  EXPECT_DOUBLE_EQ(g.reference_time, 0.5 * std::sqrt(8000 / 400e6));
}

/// The reference beam with a coating in front of it.
const std::string coated =
    "structure.layers=[{material: elastic, thickness: 2 mm, density: 1000, yield_strength: 1 MPa},"
    "{material: dh36, thickness: 48 mm, density: 7900}]";

TEST(Groups, AnElasticCoatingIsNotTheMetal) {
  const Groups g = groups(load_text(minimal_scene, {coated}));
  EXPECT_DOUBLE_EQ(g.reference_time, 0.5 * std::sqrt(7900 / 470e6));
  EXPECT_DOUBLE_EQ(g.areal_mass, 2.0 + 0.048 * 7900);
  EXPECT_DOUBLE_EQ(g.impulse_number, 64800 / (g.areal_mass * std::sqrt(470e6 / 7900)));
  EXPECT_DOUBLE_EQ(g.loading_time_ratio, 0.5 * 0.75e-3 / g.reference_time);
  EXPECT_DOUBLE_EQ(g.end, 1.5 * g.reference_time);
}

// The parent solid of a core is the first layer: its strength is used, though it does not yield itself.
TEST(Groups, ACoreYieldsWithTheStrengthOfItsParentSolid) {
  const Groups g = groups(load_text(
      minimal_scene, {"structure.core.normalised_strength=0.1",
                      "structure.layers=[{material: elastic, thickness: 5 mm, yield_strength: 300 MPa},"
                      "{material: core, thickness: 55 mm, density: 800}, {material: dh36, thickness: 5 mm}]"}));
  EXPECT_DOUBLE_EQ(g.reference_time, 0.5 * std::sqrt(8000 / 300e6));
}

TEST(Groups, WhereNothingYieldsThereIsNoReferenceTime) {
  const Groups g = groups(load_text(minimal_scene, {"structure.layers.0.material=elastic", "time.end=1 ms"}));
  for (const double none : {g.reference_time, g.impulse_number, g.loading_time_ratio}) EXPECT_TRUE(std::isnan(none));
  EXPECT_DOUBLE_EQ(g.areal_mass_ratio, 0.405);
  EXPECT_DOUBLE_EQ(g.end, 1e-3);
}

TEST(Groups, ARigidTargetIsWhatItsLayersSay) {
  const Groups g = groups(load_text(minimal_scene, {"structure.layers.0.material=elastic", "structure.type=rigid"}));
  EXPECT_NEAR(g.reference_time, 2.063e-3, 0.0005e-3);
}

// One particle in a slug that asks for half of one: I0 is its own momentum.
TEST(Groups, TheSlugIsWhatWasMadeOfIt) {
  const Scene scene = load_text(minimal_scene, {"impactor.slug.tail_speed=300 m/s"});
  const double nominal = 0.2 * 2700 * 0.1 * 0.3 * 1e-3;  // kg
  const Groups g = groups(scene, 2.0 * nominal);
  EXPECT_DOUBLE_EQ(g.areal_momentum * g.loaded_area, 2.0 * nominal * 350.0);
  EXPECT_DOUBLE_EQ(g.areal_mass_ratio, 2.0 * 0.405);
  EXPECT_DOUBLE_EQ(g.slug_pressure, 2.0 * 540.0 * 160000.0);
  EXPECT_NEAR(groups(scene, nominal).impulse_number, groups(scene).impulse_number, 1e-12);
}

TEST(Groups, EndInSeconds) { EXPECT_DOUBLE_EQ(groups(load_text(minimal_scene, {"time.end=2 ms"})).end, 2e-3); }

TEST(Groups, ASlugAtRestTakesForEver) {
  const Groups g = groups(load_text(minimal_scene, {"impactor.slug.speed=0"}));
  EXPECT_TRUE(std::isinf(g.slug_time));
  EXPECT_EQ(g.impulse_number, 0);
}

/// The reference beam, with another load.
std::string loaded(const std::string& impactor) {
  const std::string& scene = minimal_scene;
  const auto from = scene.find("impactor:");
  const auto to = scene.find("structure:");
  return scene.substr(0, from) + "impactor: " + impactor + "\n" + scene.substr(to);
}

// The slug's impulse as a rectangle of its duration: the slug's I_o and tau.
TEST(Groups, APulseHasTheGroupsOfItsImpulse) {
  const Groups g =
      groups(load_text(loaded("{type: pressure, pressure: {patch: {from: 0 m, to: 0.1 m}, "
                              "rectangular: {pressure: 86.4 MPa, duration: 0.75 ms}}}")));
  const Groups slug = groups(load_text(minimal_scene));
  EXPECT_NEAR(g.impulse_number, slug.impulse_number, 1e-12);
  EXPECT_NEAR(g.loading_time_ratio, slug.loading_time_ratio, 1e-12);
  EXPECT_DOUBLE_EQ(g.width_ratio, 0.2);
  EXPECT_DOUBLE_EQ(g.loaded_width, 0.1);
  EXPECT_DOUBLE_EQ(slug.loaded_width, 0.1);
  for (const double none : {g.areal_mass_ratio, g.slug_time, g.slug_pressure}) EXPECT_TRUE(std::isnan(none));
}

std::string tabulated(const std::string& time, const std::string& pressure) {
  return loaded("{type: pressure, pressure: {tabulated: {time: [" + time + "], pressure: [" + pressure + "]}}}");
}

// A triangle of 0.2 ms that begins at once, and the same one a millisecond later.
TEST(Groups, TauCountsFromTheBeginningOfTheLoad) {
  const double mean = 0.2e-3 / 3.0;
  const Groups at_once = groups(load_text(tabulated("0 s, 0.2 ms", "100 MPa, 0 Pa")));
  EXPECT_NEAR(at_once.loading_time_ratio, mean / at_once.reference_time, 1e-15);
  for (const char* const times : {"1 ms, 1.2 ms", "1000 us, 1200 us"}) {
    const Groups later = groups(load_text(tabulated(times, "100 MPa, 0 Pa")));
    EXPECT_NEAR(later.loading_time_ratio / at_once.loading_time_ratio, 1.0, 1e-12);
  }
  const Groups after_nothing = groups(load_text(tabulated("0 s, 0.5 ms, 1 ms, 1.2 ms", "0 Pa, 0 Pa, 0 Pa, 100 MPa")));
  EXPECT_NEAR(after_nothing.loading_time_ratio, 2.0 * at_once.loading_time_ratio, 1e-12);
}

TEST(Groups, WhereSuctionOutweighsTheMeanThereIsNoTau) {
  const Groups late = groups(load_text(tabulated("0 s, 1 ms, 1.1 ms, 2 ms", "10 MPa, 10 MPa, -9 MPa, -9 MPa")));
  EXPECT_GT(late.impulse_number, 0.0);
  EXPECT_TRUE(std::isnan(late.loading_time_ratio));
  const Groups early = groups(load_text(tabulated("0 s, 1 ms, 1.1 ms, 2 ms", "-9 MPa, -9 MPa, 10 MPa, 11 MPa")));
  EXPECT_TRUE(std::isnan(early.loading_time_ratio)) << "beyond the end of the load";
  const Groups pulled = groups(load_text(tabulated("0 s, 1 ms", "-9 MPa, -9 MPa")));
  EXPECT_TRUE(std::isnan(pulled.loading_time_ratio));
  EXPECT_TRUE(std::isnan(pulled.impulse_number));
}

TEST(Groups, WhatHasNoImpulseHasNoImpulseNumber) {
  for (const char* impactor : {"{type: none}", "{type: pressure, pressure: {rectangular: {pressure: 1 MPa}}}",
                               "{type: pressure, pressure: {rectangular: {pressure: 0 Pa, duration: 1 s}}}"}) {
    const Groups g = groups(load_text(loaded(impactor)));
    for (const double none : {g.impulse_number, g.loading_time_ratio, g.areal_momentum, g.slug_time}) {
      EXPECT_TRUE(std::isnan(none)) << impactor;
    }
    EXPECT_DOUBLE_EQ(g.loaded_width, 0.5) << impactor;  // all of the face
  }
}

}  // namespace
}  // namespace grainstep::scene
