/// The permanent deflection, of signals whose mean is known.
#include "orchestrator/record/free_oscillation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace grainstep::orchestrator {
namespace {

using Signal = std::function<double(double)>;

constexpr double turn = 2.0 * std::numbers::pi;

double no_load(double /*time*/) { return 0.0; }

/// Rows from 0 to `end`, s.
std::vector<DeflectionSample> rows(const Signal& deflection, double end, const Signal& load = no_load,
                                   int count = 500) {
  std::vector<DeflectionSample> out;
  for (int i = 0; i < count; ++i) {
    const double time = end * i / (count - 1);
    out.push_back({.time = time, .deflection = deflection(time), .load = load(time)});
  }
  return out;
}

// Discretisation: a passage is interpolated between two of some 80 rows a swing.
constexpr double of_the_amplitude = 2e-3;

TEST(FreeOscillation, ASineSwingsAboutItsMean) {
  for (const double phase : {0.0, 1.0, 2.5, 4.0, 5.5}) {
    for (const double end : {2.6, 6.3, 6.9}) {
      const auto found =
          last_free_oscillation(rows([=](double t) { return 0.3 + 0.1 * std::sin(turn * t + phase); }, end));
      ASSERT_TRUE(found) << phase << " " << end;
      EXPECT_NEAR(found->mean, 0.3, 0.1 * of_the_amplitude);
      EXPECT_NEAR(found->spread, 0.1, 0.1 * of_the_amplitude);
      EXPECT_NEAR(found->to - found->from, 1.0, of_the_amplitude);
      EXPECT_LE(found->to, end);
      EXPECT_GT(found->to, end - 0.6) << "half a swing, and a twelfth to see that it went through";
    }
  }
}

/// A short pulse: the beam deflects on by its inertia for 1 s, and springs back by a little.
double plastic(double t) {
  if (t < 1.0) return std::sin(0.25 * turn * t);
  return 0.96 + 0.04 * std::cos(turn * (t - 1.0));
}

TEST(FreeOscillation, TheRiseToThePeakIsNoPartOfIt) {
  for (const double sign : {1.0, -1.0}) {  // pressed and pulled
    const auto found = last_free_oscillation(
        rows([=](double t) { return sign * plastic(t); }, 4.4, [](double t) { return std::min(t, 0.1); }));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->mean, sign * 0.96, 0.04 * 2.0 * of_the_amplitude);
    EXPECT_NEAR(found->spread, 0.04, 0.04 * 5.0 * of_the_amplitude);
    EXPECT_GT(found->from, 1.0);
  }
}

TEST(FreeOscillation, RippleOfHigherModesMakesNoSwing) {
  for (const double times : {5.4, 6.3, 8.9}) {  // its frequency over that of the swing
    const auto ripple = [times](double t) { return t < 1.0 ? 0.0 : 0.012 * std::sin(turn * times * (t - 1.0)); };
    const auto found = last_free_oscillation(
        rows([&](double t) { return plastic(t) + ripple(t); }, 4.4, no_load, 2000));  // enough to tell of a ripple
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->mean, 0.96, 0.04 * 0.05);
    EXPECT_NEAR(found->to - found->from, 1.0, 0.1);
  }
}

TEST(FreeOscillation, TheLastOfSwingsThatDieAwayIsTheLast) {
  const auto found = last_free_oscillation(
      rows([](double t) { return 0.5 + 0.3 * std::exp(-0.7 * t) * std::cos(turn * t); }, 8.2, no_load, 800));
  ASSERT_TRUE(found);
  EXPECT_GT(found->to, 7.6);
  EXPECT_LT(found->spread, 0.3 * std::exp(-0.7 * 6.2));
  EXPECT_NEAR(found->mean, 0.5, found->spread * 0.15);
}

TEST(FreeOscillation, ItBeginsWhenTheLoadIsOver) {
  const Signal swing = [](double t) { return std::sin(turn * t); };
  EXPECT_FALSE(last_free_oscillation(rows(swing, 5.0, [](double t) { return t; }))) << "it never is";
  EXPECT_FALSE(last_free_oscillation(rows(swing, 5.0, [](double t) { return std::min(t, 4.2); })));
  const auto found = last_free_oscillation(rows(swing, 5.0, [](double t) { return std::min(t, 3.2); }));
  ASSERT_TRUE(found);
  EXPECT_GT(found->from, 3.2);
  // A blast never ends, but a thousandth is left of it after 6.9 decay times.
  EXPECT_TRUE(last_free_oscillation(rows(swing, 5.0, [](double t) { return 1.0 - std::exp(-t / 0.4); })));
  EXPECT_FALSE(last_free_oscillation(rows(swing, 5.0, [](double t) { return 1.0 - std::exp(-t / 0.8); })));
}

TEST(FreeOscillation, NothingIsSaidOfWhatDoesNotSwing) {
  EXPECT_FALSE(last_free_oscillation({}));
  EXPECT_FALSE(last_free_oscillation(rows([](double) { return 0.0; }, 5.0)));                   // a wall
  EXPECT_FALSE(last_free_oscillation(rows([](double t) { return 5.0 * t; }, 5.0)));             // a free mass
  EXPECT_FALSE(last_free_oscillation(rows([](double t) { return std::sin(turn * t); }, 0.9)));  // not once
  EXPECT_FALSE(last_free_oscillation(rows([](double t) { return plastic(t); }, 1.9)));          // nor here
  EXPECT_FALSE(last_free_oscillation(rows([](double t) { return std::sin(turn * t); }, 9, no_load, 40)));  // few rows
}

}  // namespace
}  // namespace grainstep::orchestrator
