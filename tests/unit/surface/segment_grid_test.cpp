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

TEST(SegmentGrid, CoversNothingBeforeItIsBuilt) { EXPECT_FALSE(SegmentGrid().covers({{0.0, 0.0}})); }

}  // namespace
}  // namespace grainstep::surface
