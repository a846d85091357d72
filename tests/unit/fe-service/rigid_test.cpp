// A free rigid target: Newton's law, report by report.
#include "fe-service/rigid.hpp"

#include <gtest/gtest.h>

#include "../../support/fe_scenes.hpp"
#include "fe-service/structure.hpp"

namespace grainstep::fe {
namespace {

constexpr double round_off = 1e-13;
constexpr double given = -2e-5;  // N s per window, on one node
constexpr double window = 1e-6;  // s

scene::Structure free_block(scene::Structure::Extent extent) {
  scene::Structure structure = test::beam(scene::Layer::MATERIAL_DH36, 0.1, 0.02, 1);
  structure.set_type(scene::Structure::TYPE_RIGID);
  structure.set_motion(scene::Structure::MOTION_FREE);
  structure.set_extent(extent);
  return structure;
}

class FreeBlock : public ::testing::TestWithParam<scene::Structure::Extent> {
 protected:
  FreeBlock() : ready_(block_.prepare(test::setup_of(free_block(GetParam())))) {
    wire::Start start;
    start.set_window(window);
    start.set_windows(1000);
    start.set_impactor_steps(1);
    start.set_structure_steps(2);
    block_.start(start);
  }

  wire::Report next(std::uint64_t n) {
    wire::Forces forces;
    forces.set_window(n);
    for (int i = 0; i < ready_.surface().position_size(); ++i) forces.add_impulse(i == 1 ? given : 0.0);
    wire::Report report;
    block_.advance(forces, {.report = true, .snapshot = false}, kinematics_);
    block_.report(report);
    block_.complete();
    return report;
  }

  Structure block_;
  wire::Ready ready_;
  wire::Kinematics kinematics_;
};

TEST_P(FreeBlock, WeighsWhatItsLayersDo) {
  const double half = 8000.0 * 0.02 * 0.1 * 1e-3;
  const double expected = GetParam() == scene::Structure::EXTENT_FULL ? 2.0 * half : half;
  EXPECT_NEAR(ready_.mass(), expected, round_off * expected);
  EXPECT_EQ(ready_.free_mass(), ready_.mass());
}

// The impulse of window 0 acts from t = 0 on, a later one for half a step before its t(n) and half after it.
TEST_P(FreeBlock, GainsMomentumFromTheStartOn) {
  for (std::uint64_t n = 0; n < 5; ++n) {
    const wire::Report report = next(n);
    const double before = n == 0 ? 0.0 : static_cast<double>(n) * given + 0.25 * given;  // half of one of two substeps
    EXPECT_NEAR(report.momentum().interface_impulse(1), before, round_off * std::abs(given)) << n;
    EXPECT_NEAR(report.momentum().linear(1), before, round_off * std::abs(given)) << n;
    EXPECT_EQ(report.momentum().support_impulse(1), 0.0);
    EXPECT_NEAR(report.energy().kinetic(), report.energy().interface_work(), round_off) << n;
  }
  EXPECT_NEAR(kinematics_.velocity(1) * ready_.mass() / (4.75 * given), 1.0, round_off);  // the mean over the window
}

INSTANTIATE_TEST_SUITE_P(Extents, FreeBlock,
                         ::testing::Values(scene::Structure::EXTENT_HALF, scene::Structure::EXTENT_FULL));

}  // namespace
}  // namespace grainstep::fe
