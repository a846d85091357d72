#include "surface/segment_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace grainstep::surface {
namespace {

Polyline wave(std::size_t segments, double amplitude) {
  std::vector<Vec2> nodes;
  std::vector<Polyline::Segment> joined;
  for (std::size_t i = 0; i <= segments; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(segments);
    nodes.push_back({{x, amplitude * std::sin(9.0 * x)}});
    if (i > 0) joined.push_back({static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i)});
  }
  return {nodes, joined};
}

TEST(SegmentGrid, FindsExactlyTheSegmentsWithinReach) {
  std::mt19937_64 random(3);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 * 1.4 - 0.2; };
  SegmentGrid grid;
  for (const double amplitude : {0.0, 0.05, 0.4}) {
    for (const double reach : {0.003, 0.02, 0.3}) {
      const Polyline surface = wave(97, amplitude);
      grid.rebuild(surface, reach);
      for (int i = 0; i < 500; ++i) {
        const Vec2 p{{uniform(), uniform() * amplitude}};
        std::vector<std::uint32_t> expected;
        for (std::uint32_t s = 0; s < surface.segment_count(); ++s) {
          if (surface.squared_distance(p, s) < reach * reach) expected.push_back(s);
        }
        std::vector<std::uint32_t> found;
        grid.near(surface, p, found);
        EXPECT_EQ(found, expected);
        EXPECT_TRUE(expected.empty() || grid.covers(p));
      }
    }
  }
}

// What comes over the wire may stand anywhere: cells are counted before they are made, and never become indices beyond.
TEST(SegmentGrid, SurfacesWithoutMeasureTakeNoMemory) {
  SegmentGrid grid;
  for (const double far : {1e9, 1e15, 1e200, 1.7e308}) {
    for (const Vec2& end : {Vec2{{1.0, far}}, Vec2{{far, 1.0}}, Vec2{{far, far}}}) {
      const Polyline surface({Vec2{{0.0, 0.0}}, end, Vec2{{-end[0], -end[1]}}}, {{0, 1}, {2, 0}});
      grid.rebuild(surface, 0.01);
      std::vector<std::uint32_t> found;
      grid.near(surface, {{0.0, 0.0}}, found);
      if (far < 1e150) {  // beyond it, squares are infinite
        EXPECT_THAT(found, ::testing::ElementsAre(0, 1)) << far;
      }
      grid.near(surface, end, found);
    }
  }
}

// All segments reach across the whole: in a fine grid each would be in every cell.
TEST(SegmentGrid, SegmentsThatCrossEverythingAreInFewCells) {
  constexpr std::size_t many = 20000;
  std::vector<Vec2> nodes;
  std::vector<Polyline::Segment> joined;
  for (std::size_t i = 0; i <= many; ++i) {
    const double side = i % 2 == 0 ? 0.0 : 1.0;
    nodes.push_back({{side, side + 1e-6 * static_cast<double>(i)}});
    if (i > 0) joined.push_back({static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i)});
  }
  const Polyline surface(nodes, joined);
  SegmentGrid grid;
  grid.rebuild(surface, 1e-3);
  std::vector<std::uint32_t> found;
  grid.near(surface, {{0.5, 0.5}}, found);
  EXPECT_FALSE(found.empty());
}

TEST(SegmentGrid, CoversNothingBeforeItIsBuilt) { EXPECT_FALSE(SegmentGrid().covers({{0.0, 0.0}})); }

}  // namespace
}  // namespace grainstep::surface
