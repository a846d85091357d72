#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "ledger/load_history.hpp"
#include "ledger/surface_load.hpp"

namespace grainstep::ledger {
namespace {

constexpr double kDepth = 0.5;

// Three nodes on the x1 axis at 0, 1, 3; the structure lies below (walking towards +x1 keeps it to the right).
wire::Surface flat() {
  wire::Surface out;
  for (const double x : {0.0, 0.0, 1.0, 0.0, 3.0, 0.0}) out.add_position(x);
  for (const unsigned node : {0U, 1U, 1U, 2U}) out.add_facet(node);
  return out;
}

TEST(SurfaceLoad, UniformPressureIsUniformOnUnequalSegments) {
  const SurfaceLoad load(flat(), kDepth);
  // Pressure 1 on lengths 1 and 2: consistent nodal forces b (1/2, 1/2 + 1, 1), pointing down.
  const std::array impulse{0.0, -0.25, 0.0, -0.75, 0.0, -0.5};
  for (const double p : load.impulse_per_area(impulse)) {
    EXPECT_NEAR(p, 1.0, 1e-15);
  }
  EXPECT_NEAR(load.impulse_on_face(impulse), 1.5, 1e-15);
}

// Pressure 1 on rings r = 0..1..3: 2 pi times the integrals of shape function x r, 1/6; 2/6 + 10/6; 14/6.
TEST(SurfaceLoad, UniformPressureIsUniformOnRings) {
  const SurfaceLoad load = SurfaceLoad::of_revolution(flat());
  const double turn = 2.0 * std::numbers::pi;
  const std::array impulse{0.0, -turn / 6.0, 0.0, -turn * 2.0, 0.0, -turn * 14.0 / 6.0};
  for (const double p : load.impulse_per_area(impulse)) EXPECT_NEAR(p, 1.0, 1e-14);
  EXPECT_NEAR(load.impulse_on_face(impulse), std::numbers::pi * 9.0, 1e-13);
}

// A square of side 2 in the plane x2 = 0, cut along a diagonal: outward normals (b - a) x (c - a) along +x2.
wire::Surface square() {
  wire::Surface out;
  out.set_dimension(3);
  for (const double x : {0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 0.0, 2.0, 0.0, 0.0, 2.0}) out.add_position(x);
  for (const unsigned node : {0U, 2U, 1U, 0U, 3U, 2U}) out.add_facet(node);
  return out;
}

// Pressure 1: a third of the area of every triangle to each of its nodes; the diagonal's nodes have two of them.
TEST(SurfaceLoad, UniformPressureIsUniformOnTriangles) {
  const SurfaceLoad load(square(), kDepth);
  std::vector<double> impulse(12, 0.0);
  for (const auto& [node, part] : {std::pair{0, 4.0}, {1, 2.0}, {2, 4.0}, {3, 2.0}})
    impulse[3 * node + 1] = -part / 3.0;
  for (const double p : load.impulse_per_area(impulse)) EXPECT_NEAR(p, 1.0, 1e-15);
  EXPECT_NEAR(load.impulse_on_face(impulse), 4.0, 1e-14);
  EXPECT_NEAR(load.area_of_face(), 4.0, 1e-15);
  EXPECT_THAT(load.areas(), ::testing::ElementsAre(2.0, 2.0));
  EXPECT_DOUBLE_EQ(load.middles()[0], 4.0 / 3.0);
  EXPECT_DOUBLE_EQ(load.middles()[1], 0.0);
  EXPECT_DOUBLE_EQ(load.middles()[2], 2.0 / 3.0);
}

TEST(SurfaceLoad, RefusesATriangleWithoutArea) {
  wire::Surface surface = square();
  surface.set_facet(1, 1);
  EXPECT_THROW(SurfaceLoad(surface, kDepth), InputError);
}

TEST(LoadHistory, WithoutAnAreaThatOfTheFaceIsMeant) {
  LoadHistory history(SurfaceLoad(square(), kDepth), {.window = 1.0, .steps = 1},
                      std::numeric_limits<double>::quiet_NaN());
  std::vector<double> impulse(12, 0.0);
  impulse[1] = -6.0;
  history.add(0, impulse);
  history.add(1, impulse);
  EXPECT_DOUBLE_EQ(history.transmitted(), (12.0 - 3.0) / 4.0);
}

TEST(SurfaceLoad, RefusesASurfaceOfRevolutionOnItsAxis) {
  wire::Surface surface;
  for (const double x : {0.0, -1.0, 0.0, 0.0}) surface.add_position(x);
  for (const unsigned node : {0U, 1U}) surface.add_facet(node);
  EXPECT_THROW((void)SurfaceLoad::of_revolution(surface), InputError);
}

TEST(SurfaceLoad, SegmentsAddUpToTheNodes) {
  const SurfaceLoad load(flat(), kDepth);
  const std::array impulse{7.0, -1.0, -3.0, -20.0, 2.0, 0.5};  // tangential parts do not press
  const auto per_area = load.impulse_per_area(impulse);
  const auto lengths = load.lengths();
  EXPECT_NEAR(std::inner_product(per_area.begin(), per_area.end(), lengths.begin(), 0.0) * kDepth, 20.5, 1e-13);
  EXPECT_NEAR(load.impulse_on_face(impulse), 20.5, 1e-13);
}

// A face from 0 to 2 and, around its corner, an end face down to -1: a push down on the corner presses the face alone.
TEST(SurfaceLoad, APushOnACornerPressesTheFaceThatItPointsTo) {
  wire::Surface surface;
  for (const double x : {0.0, 0.0, 2.0, 0.0, 2.0, -1.0}) surface.add_position(x);
  for (const unsigned node : {0U, 1U, 1U, 2U}) surface.add_facet(node);
  const SurfaceLoad load(surface, kDepth);
  const std::array impulse{0.0, 0.0, -3.0, -4.0, 0.0, 0.0};
  const auto per_area = load.impulse_per_area(impulse);
  EXPECT_DOUBLE_EQ(per_area[0], 4.0 / (2.0 * kDepth));
  EXPECT_DOUBLE_EQ(per_area[1], 3.0 / (1.0 * kDepth));
  EXPECT_DOUBLE_EQ(load.impulse_on_face(impulse), 4.0);
}

// A wall of one segment: friction at x goes to its corner with x/L, and is no pressure on the face.
TEST(SurfaceLoad, FrictionIsNoPartOfWhatPressesOnTheLoadedFace) {
  wire::Surface wall;
  for (const double x : {-2.0, -1.0, -2.0, 0.0, 2.0, 0.0, 2.0, -1.0}) wall.add_position(x);
  for (const unsigned node : {0U, 1U, 1U, 2U, 2U, 3U}) wall.add_facet(node);
  const SurfaceLoad load(wall, kDepth);
  const std::array impulse{0.0, 0.0, 5.0, -4.0, -3.0, -1.5, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(load.impulse_on_face(impulse), 5.5);
}

// Every upward segment takes its nodes' x2 impulses; what hangs over is no part of the face.
TEST(SurfaceLoad, AnUnevenFaceReceivesWhatItsNodesReceiveAlongX2) {
  wire::Surface ridge;
  for (const double x : {0.0, 0.0, 1.0, 0.5, 2.0, 0.0, 1.0, -3.0}) ridge.add_position(x);
  for (const unsigned node : {0U, 1U, 1U, 2U, 2U, 3U}) ridge.add_facet(node);
  const SurfaceLoad load(ridge, kDepth);
  EXPECT_DOUBLE_EQ(load.impulse_on_face(std::array{0.3, -1.0, -0.2, -2.0, 0.0, 0.0, 0.0, 0.0}), 3.0);
}

TEST(SurfaceLoad, RefusesTopologyThatDoesNotFit) {
  auto wrong = flat();
  wrong.set_facet(3, 9);
  EXPECT_THROW(SurfaceLoad(wrong, kDepth), InputError);
  auto degenerate = flat();
  degenerate.set_facet(3, 1);
  EXPECT_THROW(SurfaceLoad(degenerate, kDepth), InputError);
}

// Constant force f on one node, steps of h: impulses f h / 2, then f h. What has been received at t is f t.
TEST(LoadHistory, ConstantForceGivesLinearImpulseAtEqualSteps) {
  const double h = 0.1;
  LoadHistory history(SurfaceLoad(flat(), kDepth), {.window = h, .steps = 1}, 2.0);
  history.watch(0.25);
  history.watch(7.0);
  for (std::uint64_t n = 0; n <= 4; ++n) {
    const double step = n == 0 ? 0.5 * h : h;
    history.add(n, std::array{0.0, 0.0, 0.0, -6.0 * step, 0.0, 0.0});
    EXPECT_NEAR(history.transmitted(), 3.0 * history.time(), 1e-14);
    EXPECT_NEAR(history.received()[3], -6.0 * history.time(), 1e-14);
  }
  EXPECT_NEAR(history.watched()[0], 0.75, 1e-14);
  EXPECT_TRUE(std::isnan(history.watched()[1]));
}

TEST(LoadHistory, ConstantForceGivesLinearImpulseAtFourStepsPerWindow) {
  const double h = 0.1;
  LoadHistory history(SurfaceLoad(flat(), kDepth), {.window = h, .steps = 4}, 2.0);
  for (std::uint64_t n = 0; n <= 4; ++n) {
    const double covered = n == 0 ? 0.125 * h : h;
    history.add(n, std::array{0.0, 0.0, 0.0, -6.0 * covered, 0.0, 0.0});
    EXPECT_NEAR(history.transmitted(), 3.0 * history.time(), 1e-14);
  }
}

}  // namespace
}  // namespace grainstep::ledger
