/// @file J2 flow of (3.3) at a point along straight legs of strain, integrated as a differential equation with error
/// control: what a step-wise return must tend to. Independent of fe-service: deviator and hardening in rate form,
///     ds/dt = 2 G (dev D - 3/2 ep_dot s/q),   z = ep^n,   dz/dt = n ep^(n-1) ep_dot,   S = Y (1 + A z).
/// The rate factor is 1 below the reference rate, so there are three modes, left where an event says:
///     elastic     ep_dot = 0                                              until q = S
///     plastic     q = S: ep_dot = 3 G (s:D)/q / (3 G + Y A n ep^(n-1))    until it exceeds the reference rate, or s:D
///     < 0 viscous     ep_dot = rate0 exp((q/S - 1)/C)                         until q = S
/// z instead of ep, because the hardening slope is infinite at ep = 0 while dz/dt is finite there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace grainstep::test {

struct FlowLaw {
  double shear_modulus, bulk_modulus;                           ///< Pa
  double yield_strength, factor, exponent, rate_factor, rate0;  ///< Y (Pa), A, n, C, 1/s
};

/// Components 11, 22, 12 of a symmetric tensor; 33 follows from the trace.
struct Leg {
  double xx, yy, xy;  ///< rate of strain, 1/s (tensor shear); none along x3
  double duration;    ///< s
};

class FlowIntegration {
 public:
  explicit FlowIntegration(const FlowLaw& law) : law_(law) {}

  void run(const Leg& leg) {
    const double mean = (leg.xx + leg.yy) / 3.0;
    rate_ = {leg.xx - mean, leg.yy - mean, leg.xy};
    pressure_ += 3.0 * law_.bulk_modulus * mean * leg.duration;
    if (mode_ == Mode::kPlastic && work(y_) < 0.0) mode_ = Mode::kElastic;
    double left = leg.duration;
    double step = 1e-6 * left;
    while (left > 1e-15 * leg.duration) {
      step = std::min(step, left);
      const Trial trial = attempt(y_, step);
      if (trial.error > 1.0) {
        step *= std::max(0.2, 0.9 * std::pow(trial.error, -0.2));
        continue;
      }
      const double taken = event(trial.y) ? change(step) : (y_ = trial.y, step);
      left -= taken;
      if (taken == step) step *= std::min(4.0, 0.9 * std::pow(trial.error + 1e-10, -0.2));
    }
  }

  /// 11, 22, 12, 33.
  [[nodiscard]] std::array<double, 4> stress() const {
    return {y_[0] + pressure_, y_[1] + pressure_, y_[2], pressure_ - y_[0] - y_[1]};
  }
  [[nodiscard]] double plastic_strain() const { return std::pow(y_[3], 1.0 / law_.exponent); }
  [[nodiscard]] double mises() const { return mises(y_); }

 private:
  enum class Mode { kElastic, kPlastic, kViscous };
  using State = std::array<double, 4>;  ///< deviator 11, 22, 12 and z
  struct Trial {
    State y;
    double error;  ///< over what is allowed
  };

  [[nodiscard]] static double mises(const State& y) {
    const double zz = -y[0] - y[1];
    return std::sqrt(1.5 * (y[0] * y[0] + y[1] * y[1] + zz * zz + 2.0 * y[2] * y[2]));
  }
  [[nodiscard]] double strength(const State& y) const { return law_.yield_strength * (1.0 + law_.factor * y[3]); }
  /// s : D
  [[nodiscard]] double work(const State& y) const {
    return y[0] * rate_[0] + y[1] * rate_[1] + (y[0] + y[1]) * (rate_[0] + rate_[1]) + 2.0 * y[2] * rate_[2];
  }
  /// ep^(1-n) in terms of z.
  [[nodiscard]] double softness(const State& y) const {
    return std::pow(std::max(y[3], 0.0), 1.0 / law_.exponent - 1.0);
  }

  [[nodiscard]] double hardening_rate(const State& y) const {  // dz/dt
    const double g = 3.0 * law_.shear_modulus;
    if (mode_ == Mode::kElastic) return 0.0;
    if (mode_ == Mode::kViscous) return law_.exponent * viscous_rate(y) / softness(y);
    const double drive = g * work(y) / mises(y);
    return law_.exponent * drive / (g * softness(y) + law_.yield_strength * law_.factor * law_.exponent);
  }
  [[nodiscard]] double viscous_rate(const State& y) const {
    return law_.rate0 * std::exp((mises(y) / strength(y) - 1.0) / law_.rate_factor);
  }
  [[nodiscard]] double plastic_rate(const State& y) const {
    return mode_ == Mode::kViscous ? viscous_rate(y) : hardening_rate(y) * softness(y) / law_.exponent;
  }

  [[nodiscard]] State slope(const State& y) const {
    const double back = mode_ == Mode::kElastic ? 0.0 : 1.5 * plastic_rate(y) / mises(y);
    State result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = 2.0 * law_.shear_modulus * (rate_[i] - back * y[i]);
    result[3] = hardening_rate(y);
    return result;
  }

  /// Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19: order 5 with an error estimate of order 4.
  [[nodiscard]] Trial attempt(const State& y, double h) const {
    static constexpr double a[6][6] = {{1.0 / 5},
                                       {3.0 / 40, 9.0 / 40},
                                       {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                       {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                       {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                       {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    static constexpr double e[7] = {71.0 / 57600,      0.0,          -71.0 / 16695, 71.0 / 1920,
                                    -17253.0 / 339200, 22.0 / 525.0, -1.0 / 40};
    State k[7];
    k[0] = slope(y);
    State end = y;
    for (std::size_t stage = 0; stage < 6; ++stage) {
      end = y;
      for (std::size_t j = 0; j <= stage; ++j) {
        for (std::size_t i = 0; i < 4; ++i) end[i] += h * a[stage][j] * k[j][i];
      }
      k[stage + 1] = slope(end);
    }
    const double allowed[2] = {1e-11 * law_.yield_strength, 1e-11 * std::max(y[3], 1e-5)};
    double worst = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      double difference = 0.0;
      for (std::size_t j = 0; j < 7; ++j) difference += h * e[j] * k[j][i];
      const double error = std::abs(difference) / allowed[i == 3 ? 1 : 0];
      worst = std::isfinite(error) ? std::max(worst, error) : 1e10;
    }
    return {end, worst};
  }

  /// The mode has been left by this state.
  [[nodiscard]] bool event(const State& y) const {
    if (mode_ == Mode::kElastic) return mises(y) > strength(y) * (1.0 + 1e-13);
    if (mode_ == Mode::kPlastic) return law_.rate_factor > 0.0 && plastic_rate(y) > law_.rate0;
    return mises(y) < strength(y);
  }

  /// Goes to where the mode is left, inside a step, and into the next. Returns the time taken.
  double change(double step) {
    double low = 0.0;
    double high = step;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (event(attempt(y_, middle).y) ? high : low) = middle;
    }
    y_ = attempt(y_, high).y;
    if (mode_ == Mode::kPlastic) {
      mode_ = Mode::kViscous;
    } else {
      mode_ = work(y_) > 0.0 ? Mode::kPlastic : Mode::kElastic;
      if (mode_ == Mode::kPlastic && y_[3] > 0.0 && law_.rate_factor > 0.0 && plastic_rate(y_) > law_.rate0) {
        mode_ = Mode::kViscous;
        y_[3] = (mises(y_) * (1.0 - 1e-15) / law_.yield_strength - 1.0) / law_.factor;  // on or above the surface
      }
    }
    if (++changes_ > 1000) throw std::runtime_error("flow integration: changes its mode without end");
    return high;
  }

  FlowLaw law_;
  Mode mode_ = Mode::kElastic;
  State y_{};
  std::array<double, 3> rate_{};  ///< dev D
  double pressure_ = 0.0;         ///< mean stress, Pa
  int changes_ = 0;
};

}  // namespace grainstep::test
