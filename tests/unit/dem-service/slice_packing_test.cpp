// Spheres at random in a slice of a cylinder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "dem-service/slug/packing.hpp"

namespace grainstep::dem {
namespace {

using surface::Vec3;

constexpr double angle = std::numbers::pi / 6.0;
constexpr PackingSlice slice{.outer = 20.0, .low = 0.0, .high = 20.0, .angle = angle};

std::vector<double> equal(std::uint64_t count) { return std::vector<double>(count, 1.0); }

std::uint64_t count_for(double fraction) {
  return static_cast<std::uint64_t>(std::llround(fraction * 0.5 * angle * 20 * 20 * 20 / (std::numbers::pi / 6.0)));
}

TEST(SlicePacking, NoOverlapBetweenThePlanesAndTheNumberAskedFor) {
  for (const double fraction : {0.05, 0.2, 0.3}) {
    const std::vector<Vec3> centres = pack_at_random(slice, equal(count_for(fraction)), 1);
    ASSERT_EQ(centres.size(), count_for(fraction));
    double smallest = 1e300;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const Vec3& p = centres[i];
      EXPECT_GE(p[2], 0.5 - 1e-12);
      EXPECT_GE(std::sin(angle) * p[0] - std::cos(angle) * p[2], 0.5 - 1e-12);
      EXPECT_TRUE(p[1] >= 0.5 && p[1] <= 19.5 && std::hypot(p[0], p[2]) <= 19.5 + 1e-12);
      for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, norm(p - centres[j]));
    }
    EXPECT_GE(smallest, 1.0);
  }
}

TEST(SlicePacking, RingsOfEqualAreaHoldEqualNumbers) {
  constexpr std::size_t rings = 10;
  const std::uint64_t count = count_for(0.2);
  std::vector<int> found(rings, 0);
  const double inner2 = slice.inner(0.5) * slice.inner(0.5);
  for (const Vec3& p : pack_at_random(slice, equal(count), 3)) {
    const double part = (p[0] * p[0] + p[2] * p[2] - inner2) / (19.5 * 19.5 - inner2);
    ++found[std::min(rings - 1, static_cast<std::size_t>(part * rings))];
  }
  for (const int number : found) EXPECT_NEAR(number, static_cast<double>(count) / rings, 1.0);
}

TEST(SlicePacking, SameSeedSamePlacesOtherSeedOtherPlaces) {
  const auto first = pack_at_random(slice, equal(100), 7);
  EXPECT_EQ(first, pack_at_random(slice, equal(100), 7));
  EXPECT_NE(first, pack_at_random(slice, equal(100), 8));
}

TEST(SlicePacking, WhatDoesNotFitIsAnInputErrorThatNamesWhatWasReached) {
  try {
    (void)pack_at_random(slice, equal(count_for(0.45)), 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("solid fraction 0.3"));
    EXPECT_THAT(error.what(), testing::HasSubstr("0.382"));
  }
}

}  // namespace
}  // namespace grainstep::dem
