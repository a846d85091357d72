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
