/// @file Powers that are sampled now and then, integrated over time, with an estimate of what the gaps cost.
#pragma once

#include <cmath>
#include <cstdint>

namespace grainstep::dem {

/// Trapezoidal rule over samples at increasing steps. The estimate compares it with the rule that leaves out every
/// other sample: independent sampling noise of the power shows in this difference, and adds up like a random walk.
class SampledIntegral {
 public:
  void add(std::uint64_t step, double power, double dt) {
    if (samples_ > 0) {
      const double interval = static_cast<double>(step - last_.step) * dt;
      integral_ += 0.5 * (last_.power + power) * interval;
      if (samples_ % 2 == 0) compare(step, power, dt);
    }
    before_ = last_;
    last_ = {step, power};
    ++samples_;
  }

  [[nodiscard]] double value() const { return integral_; }  ///< J

  /// One standard deviation of the sampling error, J. With every step sampled nothing is left out, and it only says how
  /// large the error would be.
  [[nodiscard]] double error() const { return std::sqrt(squares_ / noise_share); }

 private:
  struct Sample {
    std::uint64_t step = 0;
    double power = 0.0;
  };
  // Of three samples with independent noise s, the difference fine - coarse is T (p1 - (p0 + p2)/2): variance 1.5 T^2
  // s^2 for every two intervals T, while the integral itself gathers T^2 s^2 for each: 2/1.5.
  static constexpr double noise_share = 0.75;

  void compare(std::uint64_t step, double power, double dt) {
    const double first = static_cast<double>(last_.step - before_.step) * dt;
    const double second = static_cast<double>(step - last_.step) * dt;
    const double fine = 0.5 * ((before_.power + last_.power) * first + (last_.power + power) * second);
    const double coarse = 0.5 * (before_.power + power) * (first + second);
    squares_ += (fine - coarse) * (fine - coarse);
  }

  std::uint64_t samples_ = 0;
  Sample before_, last_;
  double integral_ = 0.0;
  double squares_ = 0.0;
};

}  // namespace grainstep::dem
