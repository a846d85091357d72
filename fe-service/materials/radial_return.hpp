/// @file The local problem of J2 flow at one point, for backward Euler over a step dt: find the plastic strain
/// increment d with
///     f(d) = q_trial - 3 G d - sigma_Y(ep + d, d/dt) = 0.                                           (3.3)
///
/// Method: Newton in s = ln d with a correction of second order. In s every term of sigma_Y + 3 G d is convex and
/// increasing (exp(s); (ep + exp(s))^n is the exponential of a log-sum-exp; the rate factor is max(0, s - const);
/// products of positive increasing convex functions are convex), so f is concave and decreasing, kink and infinite
/// slope at ep = 0 included. Newton's step then goes to the right of the root from wherever it starts, and from the
/// right it approaches monotonically: no bracket is needed, only a limit of how far one step may go to the right.
/// The logarithm of the rate costs nothing, for it is s itself.
///
/// Close to the root (|step| < kSmooth, no kink between) the known curvature makes the order three: with r = f''/f',
/// which lies between 0 and 1 + 2C, and |third derivative| <= (1 + 3C) |f'|,
///     step = t - r t^2/2,  t = -f/f',    |f(s + step)| <= |f' t^3| (r^2/2 + (1 + 3C)/6) (1 + O(t)),
/// less than a fifth of |f(s)|. That bound is also what ends the iteration, so that no evaluation is spent on finding
/// out that the last one was good.
///
/// Stress is taken to be on the yield surface within kYieldTolerance: 1e-10 of it is a plastic strain of about 2e-13
/// (3 G = 490 Y), far below what a step adds (1e-6 and more), yet 1e5 times above round-off.
#pragma once

#include "fe-service/materials/dh36.hpp"

namespace grainstep::fe {

inline constexpr double kYieldTolerance = 1e-10;
inline constexpr int kMaxReturnIterations = 60;

struct ReturnPoint {
  double step;             ///< of s, towards the root
  double error;            ///< bound of |f(s + step)|, Pa
  double static_strength;  ///< Y [1 + A (ep + d)^n] at s + step, Pa; of third order in the step
};

/// An increment d at or above the root, for q_trial above the static strength at ep: all of the overshoot taken by
/// elastic unloading.
GS_ALWAYS_INLINE double largest_increment(const Dh36& law, double q_trial, double static_strength) {
  return (q_trial - static_strength) / (3.0 * law.elastic.mu);
}

/// The same where nothing better is known (first yield): all by hardening, without unloading, if that is tighter.
GS_ALWAYS_INLINE double first_increment(const Dh36& law, double q_trial, double plastic_strain,
                                        double static_strength) {
  const double unloading = largest_increment(law, q_trial, static_strength);
  const double hardening_room = (q_trial / law.yield_strength - 1.0) / (law.hardening_factor + 1e-300);
  const double exponent = std::log(hardening_room) / law.hardening_exponent;
  const double reached = std::exp(exponent < 50.0 ? exponent : 50.0);
  // Used only where the difference of strains is free of cancellation.
  const double hardening = reached > 2.0 * plastic_strain ? reached - plastic_strain : unloading;
  return unloading < hardening ? unloading : hardening;
}

/// One step from s = ln d. `log_rate_scale` is ln(dt rate0).
GS_ALWAYS_INLINE ReturnPoint return_step(const Dh36& law, double q_trial, double plastic_strain, double log_rate_scale,
                                         double s, double d) {
  constexpr double kSmooth = 0.5;     // longest step that is corrected
  constexpr double kAccepted = 1e-3;  // longest step that may end the iteration: O(t) above is below 1%
  constexpr double kLongestStep = 2.0;
  const double strain = plastic_strain + d;
  const double strength = law.static_strength(strain);
  const double log_rate = s - log_rate_scale;
  const double rate = law.rate_multiplier(log_rate);
  const double unloading = 3.0 * law.elastic.mu * d;
  const double residual = q_trial - unloading - strength * rate;
  // Derivatives with respect to s.
  const double part = d / strain;
  const double hardening = (strength - law.yield_strength) * law.hardening_exponent * part;
  const double hardening_curvature = hardening * (1.0 - (1.0 - law.hardening_exponent) * part);
  const double rate_slope = log_rate > 0.0 ? law.rate_factor : 0.0;
  const double slope = unloading + hardening * rate + strength * rate_slope;
  const double bend = (unloading + hardening_curvature * rate + 2.0 * hardening * rate_slope) / slope;
  const double newton = residual / slope;
  const double size = std::abs(newton);
  const bool kink = (log_rate > 0.0) != (log_rate + newton > 0.0);
  const double corrected = newton - (size < kSmooth && !kink ? 0.5 * bend * newton * newton : 0.0);
  const double step = corrected < kLongestStep ? corrected : kLongestStep;
  const double smooth_error =
      1.05 * slope * size * size * size * (0.5 * bend * bend + (1.0 + 3.0 * law.rate_factor) / 6.0);
  const double kink_error =
      kink ? 0.6 * slope * size * size * bend + strength * law.rate_factor * std::abs(log_rate + newton) : 0.0;
  return {step, size < kAccepted ? smooth_error + kink_error : 1e300,
          strength + step * (hardening + 0.5 * step * hardening_curvature)};
}

}  // namespace grainstep::fe
