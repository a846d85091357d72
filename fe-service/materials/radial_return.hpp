/// @file The local problem of J2 flow at one point, for backward Euler over a step dt: find the plastic strain
/// increment d with
///     f(d) = q_trial - 3 G d - sigma_Y(ep + d, d/dt) = 0.                                           (3.3)
///
/// Method: Newton in s = ln d, from an upper bound of the root. In s every term of sigma_Y + 3 G d is convex and
/// increasing (exp(s); (ep + exp(s))^n is the exponential of a log-sum-exp; the rate factor is max(0, s - const);
/// products of positive increasing convex functions are convex), so f is concave and decreasing, kink and infinite
/// slope at ep = 0 included. Newton started right of the root of such a function approaches it monotonically from the
/// right and ends quadratically: no bracket is needed. The logarithm of the rate costs nothing either, for it is s
/// itself.
///
/// Stress is taken to be on the yield surface within kYieldTolerance: 1e-10 of it is a plastic strain of about 2e-13
/// (3 G = 490 Y), far below what a step adds (1e-6 and more), yet 1e5 times above round-off.
#pragma once

#include "fe-service/materials/dh36.hpp"

namespace grainstep::fe {

inline constexpr double kYieldTolerance = 1e-10;
inline constexpr int kMaxReturnIterations = 60;

struct ReturnPoint {
  double increment;        ///< d = exp(s)
  double static_strength;  ///< Y [1 + A (ep + d)^n], Pa
  double residual;         ///< f, Pa
  double next;             ///< s of the next iteration
};

/// An s at or above the root's, for q_trial above the static strength at ep.
GS_ALWAYS_INLINE double return_start(const Dh36& law, double q_trial, double plastic_strain, double static_strength) {
  // All of the overshoot taken by elastic unloading; ...
  const double unloading = (q_trial - static_strength) / (3.0 * law.elastic.mu);
  // ... or all by hardening, without unloading: the tighter one at first yield. Used only where the difference of
  // strains is free of cancellation.
  const double hardening_room = (q_trial / law.yield_strength - 1.0) / (law.hardening_factor + 1e-300);
  const double exponent = std::log(hardening_room) / law.hardening_exponent;
  const double reached = std::exp(exponent < 50.0 ? exponent : 50.0);
  const double hardening = reached > 2.0 * plastic_strain ? reached - plastic_strain : unloading;
  return std::log(unloading < hardening ? unloading : hardening);
}

/// One Newton step from s. `log_rate_scale` is ln(dt rate0).
GS_ALWAYS_INLINE ReturnPoint return_step(const Dh36& law, double q_trial, double plastic_strain, double log_rate_scale,
                                         double s) {
  const double d = std::exp(s);
  const double strain = plastic_strain + d;
  const double strength = law.static_strength(strain);
  const double log_rate = s - log_rate_scale;
  const double rate = law.rate_multiplier(log_rate);
  const double unloading = 3.0 * law.elastic.mu * d;
  const double residual = q_trial - unloading - strength * rate;
  const double hardening_slope = (strength - law.yield_strength) * law.hardening_exponent * rate * d / strain;
  const double rate_slope = log_rate > 0.0 ? strength * law.rate_factor : 0.0;
  return {d, strength, residual, s + residual / (unloading + hardening_slope + rate_slope)};
}

}  // namespace grainstep::fe
