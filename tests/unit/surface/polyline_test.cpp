#include "surface/polyline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>

#include "base/error.hpp"

namespace grainstep::surface {
namespace {

std::vector<std::uint32_t> all_of(const Polyline& surface) {
  std::vector<std::uint32_t> all(surface.segment_count());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

ClosestPoint closest(const Polyline& surface, const Vec2& p) { return surface.closest(p, all_of(surface)); }

Vec2 point_on(const Polyline& surface, const ClosestPoint& at) { return surface.interpolate(surface.nodes(), at); }

/// Walks along +x1 at x2 = 0 and turns by `angle` at the origin: the structure lies below.
Polyline bent(double angle) {
  return {{{{-1.0, 0.0}}, {{0.0, 0.0}}, {{std::cos(angle), std::sin(angle)}}}, {{0, 1}, {1, 2}}};
}

constexpr double convex = -std::numbers::pi / 3;  // turns right, away from the outside: a corner
constexpr double concave = std::numbers::pi / 3;  // turns left: a fold

TEST(Polyline, NormalIsTheTangentTurnedLeft) {
  const Polyline flat({{{-1.0, 0.0}}, {{1.0, 0.0}}}, {{0, 1}});
  const ClosestPoint above = closest(flat, {{0.5, 0.25}});
  EXPECT_DOUBLE_EQ(above.distance, 0.25);
  EXPECT_DOUBLE_EQ(above.fraction, 0.75);
  EXPECT_EQ(above.normal, (Vec2{{0.0, 1.0}}));
  const ClosestPoint inside = closest(flat, {{0.5, -0.25}});
  EXPECT_DOUBLE_EQ(inside.distance, -0.25);
  EXPECT_EQ(inside.normal, (Vec2{{0.0, 1.0}}));
}

TEST(Polyline, CentreOnTheSurfaceStillHasANormal) {
  const Polyline corner = bent(convex);
  EXPECT_DOUBLE_EQ(closest(corner, {{-0.5, 0.0}}).distance, 0.0);
  const ClosestPoint vertex = closest(corner, {{0.0, 0.0}});
  EXPECT_DOUBLE_EQ(vertex.distance, 0.0);
  EXPECT_NEAR(vertex.normal[0], std::sin(std::numbers::pi / 6), 1e-15);  // half way between both normals
  EXPECT_NEAR(vertex.normal[1], std::cos(std::numbers::pi / 6), 1e-15);
}

TEST(Polyline, NormalTurnsSmoothlyOverAConvexCorner) {
  const Polyline corner = bent(convex);
  for (double angle = -0.3; angle <= 1.3; angle += 0.01) {  // a circle about the corner, from x2 axis clockwise
    const Vec2 direction{{std::sin(angle), std::cos(angle)}};
    const ClosestPoint found = closest(corner, 0.1 * direction);
    const double turned = std::clamp(angle, 0.0, std::numbers::pi / 3);
    EXPECT_NEAR(found.normal[0], std::sin(turned), 1e-12) << angle;
    EXPECT_NEAR(found.normal[1], std::cos(turned), 1e-12) << angle;
  }
}

TEST(Polyline, BehindAConvexCornerIsInside) {
  const ClosestPoint found = closest(bent(convex), {{-0.01, -0.02}});
  EXPECT_LT(found.distance, 0.0);
}

TEST(Polyline, InAConcaveFoldTheNearerSideIsTouchedAndTheDistanceIsContinuous) {
  const Polyline fold = bent(concave);
  // The outside opens by 120 degrees; its bisector stands at 120 degrees from the x1 axis.
  double last = closest(fold, {{-0.1, 0.05}}).distance;
  for (double x = -0.1; x <= 0.05; x += 1e-4) {
    const double distance = closest(fold, {{x, 0.1}}).distance;
    if (x > -0.1 + 1e-6) {
      EXPECT_LE(std::abs(distance - last), 1.0001e-4);
    }
    EXPECT_GT(distance, 0.0);
    last = distance;
  }
  const Vec2 bisector{{std::cos(2 * std::numbers::pi / 3), std::sin(2 * std::numbers::pi / 3)}};
  const Vec2 aside{{-1e-9, 0.0}};
  EXPECT_EQ(closest(fold, 0.1 * bisector + aside).segment, 0U);
  EXPECT_EQ(closest(fold, 0.1 * bisector - aside).segment, 1U);
}

TEST(Polyline, InsideBehindAFoldTheVertexIsClosestAndPushesOut) {
  const ClosestPoint found = closest(bent(concave), {{0.02, -0.03}});
  EXPECT_LT(found.distance, 0.0);
  EXPECT_GT(found.normal[1], 0.0);
}

TEST(Polyline, SlidingAcrossAFlatJointChangesNothingButTheSegment) {
  const Polyline flat({{{-1.0, 0.0}}, {{0.0, 0.0}}, {{1.0, 0.0}}}, {{0, 1}, {1, 2}});
  for (const double x : {-1e-6, -1e-17, 0.0, 1e-17, 1e-6}) {
    for (const double y : {0.3, -0.3}) {
      const ClosestPoint found = closest(flat, {{x, y}});
      EXPECT_NEAR(found.distance, y, 1e-15) << x;
      EXPECT_NEAR(found.normal[1], 1.0, 1e-15) << x;
      EXPECT_NEAR(point_on(flat, found)[0], x, 1e-15) << x;
    }
  }
}

TEST(Polyline, BeyondAnOpenEndIsOutside) {
  const Polyline flat({{{-1.0, 0.0}}, {{1.0, 0.0}}}, {{0, 1}});
  const ClosestPoint found = closest(flat, {{1.3, -0.4}});
  EXPECT_DOUBLE_EQ(found.distance, 0.5);
  EXPECT_NEAR(found.normal[0], 0.6, 1e-15);
}

TEST(Polyline, ClosedPieceKnowsItsInside) {
  // Clockwise, so that the structure lies to the right.
  const Polyline square({{{0, 0}}, {{0, 1}}, {{1, 1}}, {{1, 0}}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}});
  std::mt19937_64 random(5);
  for (int i = 0; i < 2000; ++i) {
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 * 3.0 - 1.0; };
    const Vec2 p{{uniform(), uniform()}};
    const bool inside = p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1;
    const ClosestPoint found = closest(square, p);
    EXPECT_EQ(found.distance < 0, inside) << p[0] << " " << p[1];
    const Vec2 back = point_on(square, found) + found.distance * found.normal;
    EXPECT_NEAR(norm(back - p), 0.0, 1e-14);
    EXPECT_NEAR(norm(found.normal), 1.0, 1e-14);
  }
}

TEST(Polyline, SpreadKeepsForceAndMoment) {
  const Polyline corner = bent(convex);
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 * 2.0 - 1.0; };
  for (int i = 0; i < 200; ++i) {
    const ClosestPoint at = closest(corner, {{uniform(), uniform()}});
    const Vec2 force{{uniform(), uniform()}};
    std::vector<Vec2> nodal(3);
    corner.spread(force, at, nodal);
    const Vec2 point = point_on(corner, at);
    Vec2 sum;
    double moment = 0.0;
    for (std::size_t n = 0; n < 3; ++n) {
      sum += nodal[n];
      moment += corner.nodes()[n][0] * nodal[n][1] - corner.nodes()[n][1] * nodal[n][0];
    }
    EXPECT_NEAR(norm(sum - force), 0.0, 1e-15);
    EXPECT_NEAR(moment, point[0] * force[1] - point[1] * force[0], 1e-15);
  }
}

TEST(Polyline, RefusesWhatIsNoSurface) {
  using Nodes = std::vector<Vec2>;
  const Nodes three{{{0, 0}}, {{1, 0}}, {{2, 0}}};
  EXPECT_THROW(Polyline(three, {{0, 3}}), InputError);
  EXPECT_THROW(Polyline(three, {{1, 1}}), InputError);
  EXPECT_THROW(Polyline(three, {{0, 1}, {0, 2}}), InputError);
  EXPECT_THROW(Polyline(three, {{0, 2}, {1, 2}}), InputError);
}

}  // namespace
}  // namespace grainstep::surface
