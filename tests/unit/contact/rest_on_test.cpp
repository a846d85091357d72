#include "contact/rest_on.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace grainstep::contact {
namespace {

using surface::Vec2;

// Each disc may sink by the smallest gap again and again: without a look at how deep they are already, that is a
// hundred thousand times everything.
TEST(RestOn, DiscsBesideTheSurfaceAreRefusedAtOnce) {
  std::vector<Vec2> nodes;
  std::vector<surface::Polyline::Segment> joined;
  constexpr std::uint32_t segments = 1000;
  for (std::uint32_t i = 0; i <= segments; ++i) {
    nodes.push_back({{0.001 * i, 0.0}});
    if (i > 0) joined.push_back({i - 1, i});
  }
  const surface::Polyline flat(nodes, joined);
  std::vector<Vec2> discs;
  discs.reserve(200);
  for (int i = 0; i < 200; ++i) discs.push_back({{1.0101 + 0.01 * i, 5.0}});
  const double radius = 0.01;
  std::vector<Vec2> far = {{{1e15, 5.0}}};
  EXPECT_THROW(rest_on(flat, std::span(&radius, 1), far), InputError);
  EXPECT_THROW(rest_on(flat, std::span(&radius, 1), discs), InputError);
}

}  // namespace
}  // namespace grainstep::contact
