#include "orchestrator/command/fidelity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"

namespace grainstep::orchestrator {
namespace {

const char* const table =
    "series,done,particles_across,refinement,impactor_ratio,structure_ratio,error_deflection,error_impulse,"
    "error_pressure,processor_seconds\n"
    "\"coarse, cheap\",8,25,2,,,1.5,0.5,10,1\n"
    "fine,3,100,4,,,0.5,0.1,2,20\n"
    "wasteful,3,50,8,,,0.6,0.1,2,30\n"
    "fixed steps,3,100,4,10,,0.1,0.1,0.1,1\n"
    "finest,1,200,8,,,0,0,0,200\n"
    "not run,0,500,15,,,,,,\n";

scene::Scene beam(double diameter, double refinement) {
  scene::Scene scene;
  scene.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  scene.mutable_impactor()->set_type(scene::Impactor::TYPE_SLUG);
  scene.mutable_impactor()->mutable_slug()->set_half_width(0.1);
  scene.mutable_impactor()->mutable_slug()->mutable_particle()->set_diameter(diameter);
  scene.mutable_structure()->set_type(scene::Structure::TYPE_BEAM);
  scene.mutable_structure()->add_layers();
  scene.mutable_structure()->mutable_mesh()->set_refinement(refinement);
  return scene;
}

TEST(Fidelity, TakesFinishedRowsWithAutomaticSteps) {
  const auto rows = read_fidelities(table);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].name, "coarse, cheap");
  EXPECT_EQ(rows[0].error_pressure, 10.0);
  EXPECT_EQ(rows[3].name, "finest");
  EXPECT_THROW(static_cast<void>(read_fidelities("series,error_deflection\na,1\n")), InputError);
}

TEST(Fidelity, OfTheNativeEngineOnlyTheReferenceCounts) {
  const auto rows = read_fidelities(std::string(table) + "\"native, fine\",3,100,4,,,0.4,0.1,2,8\n" +
                                    "\"native, finest\",1,500,15,,,0,0,0,900\n");
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows.back().name, "native, finest");
  EXPECT_EQ(cheapest_within(1.0, rows)->name, "fine");
}

TEST(Fidelity, ALuckySettingIsNoBetterThanFinerOnes) {
  const auto rows = read_fidelities(std::string(table) + "lucky,3,25,4,,,0.01,0.01,0.01,2\n");
  EXPECT_EQ(rows.back().name, "lucky");
  EXPECT_EQ(rows.back().error_deflection, 0.6);  // of "wasteful", which is finer in particles and mesh
  EXPECT_EQ(rows.back().error_pressure, 2.0);
  EXPECT_EQ(rows[3].error_deflection, 0.0);
}

TEST(Fidelity, ASceneIsAsGoodAsTheBestThatIsInNothingFiner) {
  const auto rows = read_fidelities(table);
  EXPECT_EQ(fidelity_of(beam(1e-3, 4), rows)->name, "fine");  // a/D = 100
  EXPECT_EQ(fidelity_of(beam(0.9e-3, 7), rows)->name, "fine");
  EXPECT_EQ(fidelity_of(beam(1.1e-3, 8), rows)->name, "wasteful");
  EXPECT_EQ(fidelity_of(beam(1e-3, 3), rows)->name, "coarse, cheap");
  EXPECT_EQ(fidelity_of(beam(5e-3, 8), rows), nullptr);
}

TEST(Fidelity, TheCheapestWithinALimit) {
  const auto rows = read_fidelities(table);
  EXPECT_EQ(cheapest_within(2.0, rows)->name, "coarse, cheap");
  EXPECT_EQ(cheapest_within(1.0, rows)->name, "fine");
  EXPECT_EQ(cheapest_within(0.4, rows), nullptr);  // the reference has no error of its own
  const auto scene = at_fidelity(beam(1e-3, 8), *cheapest_within(2.0, rows));
  EXPECT_DOUBLE_EQ(scene.impactor().slug().particle().diameter(), 4e-3);
  EXPECT_EQ(scene.structure().mesh().refinement(), 2);
}

TEST(Fidelity, TheTableInTheProgramSaysWhatTheReadmeDoes) {
  EXPECT_GE(measured_fidelities().size(), 10U);
  ASSERT_NE(cheapest_within(1.0, measured_fidelities()), nullptr);
  for (const Fidelity& one : measured_fidelities()) {
    EXPECT_TRUE(std::isfinite(one.error_deflection) && one.processor_seconds > 0.0) << one.name;
  }
}

TEST(Fidelity, OnlyWhatWasMeasured) {
  EXPECT_TRUE(is_like_the_measured(beam(1e-3, 8)));
  auto sandwich = beam(1e-3, 8);
  sandwich.mutable_structure()->add_layers();
  EXPECT_FALSE(is_like_the_measured(sandwich));
}

}  // namespace
}  // namespace grainstep::orchestrator
