// A structure on several threads gives the bits of one.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../../support/fe_scenes.hpp"
#include "fe-service/structure.hpp"

namespace grainstep::fe {
namespace {

using test::beam;
using test::setup_of;

/// Impulses, N s, under which it yields, uneven so that no two rows are alike.
wire::Forces forces_of(std::uint64_t window, int nodes) {
  wire::Forces forces;
  forces.set_window(window);
  for (int k = 0; k < nodes; ++k) {
    forces.add_impulse(1e-5 * std::sin(0.7 * k + 0.1 * static_cast<double>(window)));
    forces.add_impulse(window < 40 ? -4e-5 * (1.0 + std::cos(1.1 * k)) : 0.0);
  }
  return forces;
}

/// All that is said in a run, as bytes.
std::string run_with(int threads, const wire::Setup& setup) {
  Structure structure(threads);
  const wire::Ready ready = structure.prepare(setup);
  wire::Start start;
  start.set_window(ready.preferred_step());
  start.set_windows(1000);
  start.set_impactor_steps(1);
  start.set_structure_steps(1);
  structure.start(start);
  std::string bytes;
  double plastic = 0.0;
  for (std::uint64_t n = 0; n <= 100; ++n) {
    wire::Kinematics next;
    wire::Report report;
    structure.advance(forces_of(n, ready.surface().position_size() / 2), {.report = true, .snapshot = n == 100}, next);
    structure.report(report);
    plastic = report.energy().plastic();
    report.clear_timing();
    next.AppendToString(&bytes);
    report.AppendToString(&bytes);
    if (n == 100) {
      wire::Snapshot snapshot;
      structure.snapshot(snapshot);
      snapshot.AppendToString(&bytes);
    }
    structure.complete();
  }
  EXPECT_GT(plastic, 0.0) << "nothing yields: the comparison says little";
  return bytes;
}

void expect_same(const wire::Setup& setup) {
  const std::string alone = run_with(1, setup);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(run_with(threads, setup), alone) << threads << " threads";
}

const scene::Structure kBeam = beam(scene::Layer::MATERIAL_DH36, 0.05, 0.01, 4);

TEST(StructureThreads, ABeamIsTheSameWithAnyNumber) { expect_same(setup_of(kBeam)); }

TEST(StructureThreads, ASandwichIsTheSameWithAnyNumber) {
  scene::Structure sandwich = kBeam;
  *sandwich.add_layers() = test::core(0.02, 1000.0, 1e-5);
  *sandwich.add_layers() = test::steel(scene::Layer::MATERIAL_DH36, 0.01);
  test::set_core(sandwich, 0.05);
  expect_same(setup_of(sandwich));
}

TEST(StructureThreads, APlateIsTheSameWithAnyNumber) {
  scene::Structure plate = kBeam;
  plate.set_type(scene::Structure::TYPE_PLATE);
  wire::Setup setup = setup_of(plate);
  setup.set_symmetry(scene::SYMMETRY_AXISYMMETRIC);
  expect_same(setup);
}

TEST(StructureThreads, BulkViscosityIsTheSameWithAnyNumber) {
  scene::Structure viscous = kBeam;
  viscous.mutable_bulk_viscosity()->set_linear(0.06);
  viscous.mutable_bulk_viscosity()->set_quadratic(1.2);
  expect_same(setup_of(viscous));
}

}  // namespace
}  // namespace grainstep::fe
