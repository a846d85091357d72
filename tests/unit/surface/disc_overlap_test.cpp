#include "surface/disc_overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace grainstep::surface {
namespace {

Polyline open_line(const std::vector<Vec2>& nodes) {
  std::vector<Polyline::Segment> segments;
  for (std::uint32_t i = 0; i + 1 < nodes.size(); ++i) segments.push_back({i, i + 1});
  return {nodes, segments};
}

/// Along x1 with nodes at uneven places.
Polyline flat() {
  return open_line({{{-9, 0}}, {{-1.2, 0}}, {{-1, 0}}, {{-0.1, 0}}, {{0.25, 0}}, {{0.8, 0}}, {{9, 0}}});
}

/// A dent under an edge, and a fold.
Polyline rough() {
  return open_line(
      {{{-9, 0.2}}, {{-1.1, 0.1}}, {{-0.6, -0.3}}, {{-0.2, -0.1}}, {{0.3, -0.45}}, {{0.7, 0.05}}, {{9, -0.4}}});
}

struct Found {
  DiscOverlap overlap;
  std::vector<NodeShare> shares;
};

Found find(const Polyline& surface, const Vec2& centre, double radius) {
  std::vector<std::uint32_t> all(surface.segment_count());
  std::iota(all.begin(), all.end(), 0U);
  Found found;
  DiscOverlapFinder finder;
  found.overlap = finder.find(surface, centre, radius, all, found.shares);
  return found;
}

/// Of a circular segment of the unit disc, by Simpson's rule over the depths of its chords.
double segment_measure(double depth) {
  constexpr int steps = 2000;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    // Depth d = depth u^2: the integrand 4/3 c(d)^3 starts with the root of it.
    const double u = static_cast<double>(i) / steps;
    const double d = depth * u * u;
    const double value = 4.0 / 3.0 * std::pow(d * (2.0 - d), 1.5) * 2.0 * depth * u;
    sum += value * (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return sum / (3.0 * steps);
}

TEST(DiscOverlap, IsACircularSegmentOnAFlatSurfaceHoweverItIsCut) {
  for (const double depth : {1e-5, 1e-3, 0.1, 0.5, 1.0, 1.7}) {
    const Found found = find(flat(), {{0.05, 1.0 - depth}}, 1.0);
    EXPECT_NEAR(found.overlap.measure / segment_measure(depth), 1.0, 1e-5) << depth;
    const double slope = 4.0 / 3.0 * std::pow(depth * (2.0 - depth), 1.5);
    EXPECT_NEAR(found.overlap.weight, slope, 1e-14);
    EXPECT_NEAR(found.overlap.gradient[1], slope, 1e-14);
    EXPECT_NEAR(found.overlap.gradient[0], 0.0, 1e-14);
    const FlatOverlap seen = flat_overlap(found.overlap.measure, 1.0);
    EXPECT_NEAR(seen.depth / depth, 1.0, 1e-5) << depth;
    EXPECT_NEAR(seen.per_measure * slope, 1.0, 3e-5) << depth;
  }
}

TEST(DiscOverlap, HasNothingInCommonWithoutTouch) {
  const Found found = find(flat(), {{0.05, 1.0 + 1e-9}}, 1.0);
  EXPECT_EQ(found.overlap.measure, 0.0);
  EXPECT_TRUE(found.shares.empty());
}

/// The gradients are the derivatives of the measure by each node and by the centre.
TEST(DiscOverlap, GradientsAreDerivatives) {
  constexpr double step = 1e-6;
  const Vec2 centre{{0.05, 0.55}};
  Polyline surface = rough();
  const Found found = find(surface, centre, 1.0);
  std::vector<Vec2> gradient(surface.node_count());
  for (const NodeShare& share : found.shares) gradient[share.node] += share.gradient;
  Vec2 all;
  for (std::size_t node = 0; node < surface.node_count(); ++node) {
    all += gradient[node];
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double at = surface.nodes()[node][axis];
      surface.nodes()[node][axis] = at + step;
      const double above = find(surface, centre, 1.0).overlap.measure;
      surface.nodes()[node][axis] = at - step;
      const double below = find(surface, centre, 1.0).overlap.measure;
      surface.nodes()[node][axis] = at;
      EXPECT_NEAR((above - below) / (2.0 * step), gradient[node][axis], 1e-8) << node << ", " << axis;
    }
  }
  EXPECT_NEAR(all[0], found.overlap.gradient[0], 1e-14);
  EXPECT_NEAR(all[1], found.overlap.gradient[1], 1e-14);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    Vec2 moved = centre;
    moved[axis] += step;
    const double above = find(surface, moved, 1.0).overlap.measure;
    moved[axis] -= 2.0 * step;
    const double below = find(surface, moved, 1.0).overlap.measure;
    EXPECT_NEAR((above - below) / (2.0 * step), -found.overlap.gradient[axis], 1e-8);
  }
}

/// What presses on the part in the disc has no moment about its centre.
TEST(DiscOverlap, GradientsHaveNoMomentAboutTheCentre) {
  const Vec2 centre{{-0.15, 0.5}};
  const Polyline surface = rough();
  const Found found = find(surface, centre, 1.0);
  double moment = 0.0;
  for (const NodeShare& share : found.shares) {
    const Vec2 arm = surface.nodes()[share.node] - centre;
    moment += arm[0] * share.gradient[1] - arm[1] * share.gradient[0];
  }
  EXPECT_NEAR(moment, 0.0, 1e-14);
}

TEST(DiscOverlap, TwoPlacesAtOnceAddUp) {
  // A ridge that the disc straddles: it reaches into both slopes, but not into the groove between them.
  const Polyline groove = open_line({{{-9, 0}}, {{-0.5, 0}}, {{0, -5}}, {{0.5, 0}}, {{9, 0}}});
  const Found both = find(groove, {{0, 0.8}}, 1.0);
  const Polyline left = open_line({{{-9, 0}}, {{-0.5, 0}}, {{0, -5}}, {{0.0, -9}}});
  const Found one = find(left, {{0, 0.8}}, 1.0);
  EXPECT_NEAR(both.overlap.measure, 2.0 * one.overlap.measure, 1e-14);
  EXPECT_NEAR(both.overlap.gradient[0], 0.0, 1e-15);
}

TEST(DiscOverlap, AnOpenPieceEndsAtARightAngle) {
  // Half the disc beside the end: a quarter of it is structure. Of the whole unit disc B is pi/2.
  const Polyline surface = open_line({{{-9, 0}}, {{-0.4, 0}}, {{0, 0}}});
  const Found found = find(surface, {{0, 0}}, 1.0);
  EXPECT_NEAR(found.overlap.measure, std::numbers::pi / 8.0, 1e-14);
  EXPECT_NEAR(found.overlap.gradient[0], 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(found.overlap.gradient[1], 2.0 / 3.0, 1e-15);
}

TEST(DiscOverlap, ChangesSmoothlyOverACorner) {
  const Polyline corner = open_line({{{-9, 0}}, {{-0.1, 0}}, {{0, 0}}, {{0, -0.1}}, {{0, -9}}});
  double last = find(corner, {{-0.5, 0.9}}, 1.0).overlap.measure;
  for (double x = -0.5 + 1e-3; x < 0.6; x += 1e-3) {
    const Found found = find(corner, {{x, 0.9}}, 1.0);
    EXPECT_LT(std::abs(found.overlap.measure - last), 1e-3 * (found.overlap.weight + 1e-3)) << x;
    last = found.overlap.measure;
  }
}

TEST(DiscOverlap, MeanLengthOfSegments) { EXPECT_NEAR(mean_length(flat()), 3.0, 1e-15); }

}  // namespace
}  // namespace grainstep::surface
