/// @file Histories against the integrals that one writes down for them.
#include "load/pressure_history.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainstep::load {
namespace {

constexpr double round_off = 1e-14;  // relative: a few operations, or a sum of some hundred steps

scene::Pressure rectangular(double pressure, double duration) {
  scene::Pressure out;
  out.mutable_rectangular()->set_pressure(pressure);
  out.mutable_rectangular()->set_duration(duration);
  return out;
}

scene::Pressure exponential(double peak, double decay_time) {
  scene::Pressure out;
  out.mutable_exponential()->set_peak(peak);
  out.mutable_exponential()->set_decay_time(decay_time);
  return out;
}

/// 0 at 1 s, 6 Pa at 3 s, 2 Pa at 4 s, and an end with a jump.
scene::Pressure table() {
  scene::Pressure out;
  for (const double t : {1.0, 3.0, 4.0}) out.mutable_tabulated()->add_time(t);
  for (const double p : {0.0, 6.0, 2.0}) out.mutable_tabulated()->add_pressure(p);
  return out;
}

/// The impulses of steps that end nowhere in particular, added up.
double in_steps(const scene::Pressure& pressure, double end, double step) {
  double sum = impulse(pressure, 0.0, 0.5 * step);
  int k = 1;
  for (; (k - 0.5) * step < end; ++k) sum += impulse(pressure, (k - 0.5) * step, (k + 0.5) * step);
  return sum;
}

TEST(PressureHistory, ARectangleIsPressureTimesTime) {
  const scene::Pressure pulse = rectangular(5.0, 2.0);
  EXPECT_EQ(impulse(pulse, 0.0, 1.0), 5.0);
  EXPECT_EQ(impulse(pulse, 1.5, 9.0), 2.5);
  EXPECT_EQ(impulse(pulse, 2.0, 3.0), 0.0);
  EXPECT_EQ(impulse(pulse, -1.0, 1.0), 5.0);
  EXPECT_EQ(moments(pulse).impulse, 10.0);
  EXPECT_EQ(moments(pulse).mean_time, 1.0);
  EXPECT_EQ(moments(pulse).onset, 0.0);
  EXPECT_EQ(moments(pulse).end, 2.0);
  EXPECT_EQ(pressure_at(pulse, 1.9), 5.0);
  EXPECT_EQ(pressure_at(pulse, 2.0), 0.0);
}

TEST(PressureHistory, ARectangleWithoutEndHasNoImpulse) {
  scene::Pressure pressure;
  pressure.mutable_rectangular()->set_pressure(5.0);
  EXPECT_EQ(impulse(pressure, 10.0, 12.0), 10.0);
  EXPECT_TRUE(std::isinf(moments(pressure).impulse));
}

TEST(PressureHistory, AnExponentialIsItsAntiderivative) {
  const scene::Pressure blast = exponential(8.0, 0.5);
  EXPECT_NEAR(impulse(blast, 0.2, 0.7), 4.0 * (std::exp(-0.4) - std::exp(-1.4)), 4.0 * round_off);
  EXPECT_DOUBLE_EQ(impulse(blast, 0.0, 1e9), 4.0);
  EXPECT_EQ(moments(blast).impulse, 4.0);
  EXPECT_EQ(moments(blast).mean_time, 0.5);
  // A step of a millionth of the decay time: no digits may be lost in a difference of exponentials.
  EXPECT_NEAR(impulse(blast, 0.3, 0.3 + 5e-7) / (8.0 * std::exp(-0.6) * 5e-7 * (1.0 - 0.5e-6)), 1.0, 1e-9);
}

TEST(PressureHistory, ATableIsItsTrapezia) {
  const scene::Pressure points = table();
  EXPECT_DOUBLE_EQ(impulse(points, 0.0, 9.0), 6.0 + 4.0);
  EXPECT_DOUBLE_EQ(impulse(points, 2.0, 3.5), 0.5 * (3.0 + 6.0) + 0.25 * (6.0 + 4.0));
  EXPECT_EQ(impulse(points, 0.0, 1.0), 0.0);
  EXPECT_EQ(impulse(points, 4.0, 5.0), 0.0);
  EXPECT_DOUBLE_EQ(pressure_at(points, 2.0), 3.0);
  EXPECT_EQ(pressure_at(points, 4.5), 0.0);
  EXPECT_DOUBLE_EQ(moments(points).impulse, 10.0);
  // A triangle's centre of gravity is at 2/3 (1 + 4/3 s), a trapezium's at 3 + (6 + 2 * 2)/(3 * (6 + 2)) s.
  EXPECT_DOUBLE_EQ(moments(points).mean_time, (6.0 * (1.0 + 4.0 / 3.0) + 4.0 * (3.0 + 10.0 / 24.0)) / 10.0);
}

TEST(PressureHistory, ATableBeginsWhereItIsNotZeroAnyMore) {
  scene::Pressure pressure;
  for (const double t : {0.0, 1.0, 2.0, 3.0, 5.0}) pressure.mutable_tabulated()->add_time(t);
  for (const double p : {0.0, 0.0, -4.0, 0.0, 0.0}) pressure.mutable_tabulated()->add_pressure(p);
  EXPECT_EQ(moments(pressure).onset, 1.0);
  EXPECT_EQ(moments(pressure).end, 3.0);
  pressure.mutable_tabulated()->set_pressure(0, 1.0);
  EXPECT_EQ(moments(pressure).onset, 0.0);
}

TEST(PressureHistory, WhatIsAlwaysZeroNeverBegins) {
  EXPECT_TRUE(std::isnan(moments(rectangular(0.0, 2.0)).onset));
  EXPECT_TRUE(std::isnan(moments(exponential(0.0, 2.0)).onset));
}

TEST(PressureHistory, StepsAddUpToTheImpulseWhateverTheirLength) {
  for (const double step : {0.0137, 0.3, 1.7}) {
    EXPECT_NEAR(in_steps(rectangular(5.0, 2.0), 2.0, step), 10.0, 10.0 * 20 * round_off) << step;
    EXPECT_NEAR(in_steps(table(), 4.0, step), 10.0, 10.0 * 20 * round_off) << step;
    EXPECT_NEAR(in_steps(exponential(8.0, 0.5), 40.0, step), 4.0, 4.0 * 20 * round_off) << step;
  }
}

}  // namespace
}  // namespace grainstep::load
