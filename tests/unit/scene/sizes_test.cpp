#include "scene/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

std::string with(const std::string& sizes) {
  return replaced(minimal_scene, "    particle:\n", "    size_distribution: " + sizes + "\n    particle:\n");
}

Sizes sizes_of(const std::string& text, int dimension = 2) {
  return {load_text(with(text)).impactor().slug(), dimension};
}

double mean(const std::vector<double>& all) {
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

TEST(Sizes, AreEqualUnlessTheSceneSaysOtherwise) {
  const Sizes sizes(load_text(minimal_scene).impactor().slug(), 2);
  EXPECT_TRUE(sizes.equal());
  EXPECT_EQ(sizes.mean_of_power(3), 1.0);
  EXPECT_EQ(sizes.descending(3), std::vector<double>(3, 1.0));
}

TEST(Sizes, UniformByNumber) {
  const Sizes sizes = sizes_of("{uniform: {width: 0.3}}");
  EXPECT_NEAR(sizes.smallest(), 0.7, 1e-12);
  EXPECT_NEAR(sizes.largest(), 1.3, 1e-12);
  EXPECT_NEAR(sizes.not_exceeded_by(0.25), 0.85, 1e-12);
  EXPECT_NEAR(sizes.mean_of_power(1), 1.0, 1e-12);
  EXPECT_NEAR(sizes.mean_of_power(2), 1.0 + 0.03, 1e-7);  // 1 + w^2/3
  const auto all = sizes.descending(1000);
  EXPECT_TRUE(std::is_sorted(all.rbegin(), all.rend()));
  EXPECT_NEAR(mean(all), 1.0, 1e-12);
}

// By mass: the number density is that of the mass over D^k, and the mean over it, sum of m D over sum of m, is 1.
TEST(Sizes, UniformByMass) {
  for (const int dimension : {2, 3}) {
    const Sizes sizes = sizes_of("{by: mass, uniform: {width: 0.5}}", dimension);
    EXPECT_NEAR(sizes.mean_of_power(dimension + 1) / sizes.mean_of_power(dimension), 1.0, 1e-6);
    EXPECT_NEAR(sizes.mean_of_power(dimension),
                dimension == 2 ? 1.0 / ((1.0 / 0.5 - 1.0 / 1.5)) : 1.0 / (0.5 * (1.0 / 0.25 - 1.0 / 2.25)), 1e-5);
  }
}

TEST(Sizes, BellsAreCutAndKeepTheirMean) {
  const Sizes normal = sizes_of("{normal: {deviation: 0.2, cut: 3}}");
  EXPECT_NEAR(normal.smallest(), 0.4, 1e-9);
  EXPECT_NEAR(normal.largest(), 1.6, 1e-9);
  EXPECT_NEAR(normal.mean_of_power(1), 1.0, 1e-9);
  EXPECT_NEAR(std::sqrt(normal.mean_of_power(2) - 1.0), 0.2, 0.003);  // 1.3% less of a bell cut at 3
  const Sizes lognormal = sizes_of("{lognormal: {deviation: 0.3}}");
  EXPECT_NEAR(lognormal.mean_of_power(1), 1.0, 1e-9);
  EXPECT_NEAR(lognormal.largest() / lognormal.smallest(), std::exp(4.0 * 0.3), 1e-9);
  EXPECT_NEAR(lognormal.not_exceeded_by(0.5), std::sqrt(lognormal.smallest() * lognormal.largest()), 1e-5);
}

TEST(Sizes, TwoSizesAndTables) {
  const Sizes two = sizes_of("{bidisperse: {ratio: 3, large: 0.25}}");
  EXPECT_NEAR(two.smallest(), 1.0 / 1.5, 1e-12);
  EXPECT_NEAR(two.largest(), 3.0 / 1.5, 1e-12);
  const auto all = two.descending(100);
  EXPECT_EQ(std::count(all.begin(), all.end(), two.largest()), 25);
  // Half the mass each: four small discs for one of twice the diameter, the mean of D over mass is 1.
  const Sizes table = sizes_of("{by: mass, tabulated: {size: [150, 300], fraction: [0.5, 0.5]}}");
  const auto sieved = table.descending(100);
  EXPECT_EQ(std::count(sieved.begin(), sieved.end(), table.largest()), 20);
  EXPECT_NEAR(table.largest(), 300.0 / 225.0, 1e-12);
}

std::string complaint(const std::string& sizes) { return load_error(with(sizes)); }

TEST(Sizes, RulesSayWhatToChange) {
  const std::string at = "x.yaml:8: impactor.slug.size_distribution";
  EXPECT_EQ(complaint("{by: mass}"), at + ": needs a shape: one of uniform, normal, lognormal, bidisperse, tabulated");
  EXPECT_EQ(
      complaint("{uniform: {width: 0.9}}"),
      at + ".uniform.width: the largest particles are 19 times as wide as the smallest; expected at most 10 times: "
           "take a narrower distribution");
  EXPECT_EQ(complaint("{normal: {deviation: 0.5}}"),
            at + ".normal.deviation: with a cut at 2 deviations the smallest particle has no size left; expected less "
                 "than 0.5");
  EXPECT_EQ(complaint("{tabulated: {size: [1, 2, 3], fraction: [0.5, 0.5]}}"),
            at + ".tabulated.fraction: 2 fractions for 3 sizes; expected one for each");
  EXPECT_EQ(complaint("{tabulated: {size: [1, 2], fraction: [0.5, 0.4]}}"),
            at + ".tabulated.fraction: the fractions sum to 0.9; expected 1");
  EXPECT_EQ(complaint("{tabulated: {size: [2, 1], fraction: [0.5, 0.5]}}"),
            at + ".tabulated.size.1: 1 follows 2; sizes must increase strictly");
  EXPECT_EQ(complaint("{bidisperse: {ratio: 12, large: 0.5}}").substr(0, 60),
            (at + ".bidisperse.ratio: the largest").substr(0, 60));
  EXPECT_NE(load_error(replaced(with("{uniform: {width: 0.5}}"), "200 um", "0.15 m")).find("a particle of 0.225 m"),
            std::string::npos);
}

}  // namespace
}  // namespace grainstep::scene
