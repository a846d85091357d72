// A structure that is saved and goes on elsewhere gives the bits of one that was not.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "../../support/fe_scenes.hpp"
#include "fe-service/structure.hpp"

namespace grainstep::fe {
namespace {

using test::beam;
using test::setup_of;

constexpr std::uint64_t windows = 120;

wire::Start start_of(std::uint64_t first) {
  wire::Start start;
  start.set_window(2e-7);
  start.set_windows(windows);
  start.set_impactor_steps(1);
  start.set_structure_steps(1);
  start.set_report_every(7);
  start.set_first_window(first);
  return start;
}

wire::Forces forces_of(std::uint64_t window, int nodes) {
  wire::Forces forces;
  forces.set_window(window);
  for (int k = 0; k < nodes; ++k) {
    forces.add_impulse(2e-6 * std::sin(0.7 * k + 0.1 * static_cast<double>(window)));
    forces.add_impulse(window < 60 ? -6e-5 * (1.0 + std::cos(1.1 * k)) : 0.0);
  }
  return forces;
}

/// What a run says, window by window, and its states.
struct Told {
  std::map<std::uint64_t, std::string> by_window;
  std::map<std::uint64_t, std::string> states;
  double plastic_work = 0.0;
};

Told run(const wire::Setup& setup, std::uint64_t first, const std::string* state) {
  Told told;
  Structure structure;
  const int nodes = structure.prepare(setup).surface().position_size() / 2;
  structure.start(start_of(first));
  if (state != nullptr) structure.restore(*state);
  for (std::uint64_t n = first; n <= windows; ++n) {
    wire::Kinematics next;
    wire::Report report;
    wire::Snapshot snapshot;
    structure.advance(forces_of(n, nodes), {.report = true, .snapshot = true}, next);
    structure.report(report);
    structure.snapshot(snapshot);
    structure.complete();
    told.by_window[n] = next.SerializeAsString() + report.SerializeAsString() + snapshot.SerializeAsString();
    told.states[n] = structure.save();
    told.plastic_work = report.energy().plastic();
  }
  return told;
}

/// `yields`: it must have, or the test tells little.
void expect_the_same_bits(const wire::Setup& setup, bool yields) {
  const Told whole = run(setup, 0, nullptr);
  EXPECT_EQ(whole.plastic_work > 0.0, yields);
  for (const std::uint64_t window : {0, 1, 33, 90}) {
    const Told rest = run(setup, window + 1, &whole.states.at(window));
    for (const auto& [n, bytes] : rest.by_window)
      ASSERT_TRUE(bytes == whole.by_window.at(n)) << n << " from " << window;
    EXPECT_TRUE(rest.states.at(windows) == whole.states.at(windows)) << "from " << window;
  }
}

scene::Structure yielding_beam() { return beam(scene::Layer::MATERIAL_DH36, 0.05, 0.004, 3); }

TEST(StructureState, OfABeamThatYields) { expect_the_same_bits(setup_of(yielding_beam()), true); }

TEST(StructureState, OfAPlateThatResistsChangesOfVolume) {
  scene::Structure plate = yielding_beam();
  plate.set_type(scene::Structure::TYPE_PLATE);
  plate.mutable_bulk_viscosity()->set_linear(0.06);
  plate.mutable_bulk_viscosity()->set_quadratic(1.2);
  wire::Setup setup = setup_of(plate);
  setup.set_symmetry(scene::SYMMETRY_AXISYMMETRIC);
  expect_the_same_bits(setup, true);
}

TEST(StructureState, OfAFreeRigidTarget) {
  scene::Structure target = yielding_beam();
  target.set_type(scene::Structure::TYPE_RIGID);
  target.set_motion(scene::Structure::MOTION_FREE);
  for (scene::Layer& layer : *target.mutable_layers()) layer.set_density(8000.0);
  expect_the_same_bits(setup_of(target), false);
}

TEST(StructureState, OfAnotherModelIsRefused) {
  const Told whole = run(setup_of(yielding_beam()), 0, nullptr);
  const std::string& state = whole.states.at(5);
  const auto refused = [](const scene::Structure& structure, const std::string& bytes) {
    Structure other;
    static_cast<void>(other.prepare(setup_of(structure)));
    other.start(start_of(6));
    EXPECT_THROW(other.restore(bytes), std::range_error);
  };
  refused(yielding_beam(), state.substr(0, state.size() - 1));
  refused(yielding_beam(), state + "x");
  refused(beam(scene::Layer::MATERIAL_DH36, 0.05, 0.004, 4), state);
}

}  // namespace
}  // namespace grainstep::fe
