/// @file Metallic foam after Deshpande and Fleck, with the plastic Poisson's ratio 0 (equations 4.7 to 4.14):
///     s_hat^2 = (s_e^2 + alpha^2 s_m^2)/(1 + (alpha/3)^2),  alpha = 3/sqrt(2)                              (4.8)
///     s_hat = s_c(e_hat) + eta e_hat_dot                                                             (4.7), (4.9)
///     s_c = s_pl up to e_hat = -ln(1 - eps_D), infinite beyond                                             (4.12)
/// With this alpha s_hat^2 = s : s, all components counted, and the normal to the yield surface is s/s_hat. So the
/// plastic strain rate is e_hat_dot s/s_hat, and e_hat_dot its length. An infinite strength is no flow at all: a point
/// that has come to the end of its plateau is elastic from then on, in tension and shear too. e_hat never falls.
///
/// A step is backward Euler. With x = d/s_hat, d the increment of e_hat, deviator and mean stress shrink alone:
///     s' = s'_trial/(1 + 2 mu x),   s_m = s_m,trial/(1 + 3 K x),   1/s_hat = f(x)
///     s_pl f(x) + (eta/dt) x = 1                                                      the flow rule over s_hat
/// f is concave and increasing: it is 1/sqrt(1/u^2 + 1/v^2), concave and increasing in u and v, of two straight lines
/// in x. So Newton's method from x = 0 climbs to the only root without passing it, at any step and viscosity, none
/// included. Where the increment x/f(x), which grows with x, is more than what the plateau has left (r), the step ends
/// at
///     f(x) = x/r,
/// and Newton's method from the first root comes down to that one without passing it, for f - x/r is concave as well.
#pragma once

#include "fe-service/materials/elastic.hpp"

namespace grainstep::fe {

/// After the stress: e_hat.
enum FoamComponent : int { kFoamStrain = kStressState, kFoamState };

struct Foam {
  Elastic elastic;
  double strength;   ///< s_pl, Pa
  double locked;     ///< e_hat at which the plateau ends, -ln(1 - eps_D)
  double viscosity;  ///< eta, Pa s

  static constexpr LawTraits kTraits = {
      .word = nullptr, .state = kFoamState, .flow = kFoamStrain, .keeps_volume = false, .seconds = 1.0 / 80e6};
  using Memory = FullMemory;

  [[nodiscard]] GS_ALWAYS_INLINE const Elastic& elasticity() const { return elastic; }
  /// eta/dt.
  [[nodiscard]] GS_ALWAYS_INLINE double step_parameter(double step) const { return viscosity / step; }
  [[nodiscard]] double initial(int /*component*/) const { return 0.0; }
};

/// Of the flow rule, relative.
inline constexpr double kFoamTolerance = 1e-12;
inline constexpr int kMaxFoamIterations = 60;

/// s : s of the deviator and of the mean part; their sum is s_hat^2, Pa^2.
struct FoamStress {
  double deviatoric, spherical;
};

GS_ALWAYS_INLINE FoamStress foam_stress(const Stress& s) {
  const double p = mean(s);
  const Stress d = deviator(s);
  return {contract(d, d), 3.0 * p * p};
}

/// By how much s_hat is beyond the strength, Pa; negative where there is nothing left to flow.
GS_ALWAYS_INLINE double foam_overshoot(const Foam& law, const FoamStress& trial, double strain) {
  const double over = std::sqrt(trial.deviatoric + trial.spherical) - law.strength;
  return strain < law.locked ? over : -law.strength;
}

/// 1/s_hat and its slope.
struct Softness {
  double value, slope;
};

GS_ALWAYS_INLINE Softness softness(const Foam& law, const FoamStress& trial, double x) {
  const double shear = 2.0 * law.elastic.mu;
  const double bulk = 3.0 * law.elastic.lambda + 2.0 * law.elastic.mu;
  const double u = 1.0 / (1.0 + shear * x);
  const double v = 1.0 / (1.0 + bulk * x);
  const double deviatoric = trial.deviatoric * u * u;
  const double spherical = trial.spherical * v * v;
  const double square = 1.0 / (deviatoric + spherical);
  const double value = std::sqrt(square);
  return {value, value * square * (deviatoric * u * shear + spherical * v * bulk)};
}

struct FoamIteration {
  double x;     ///< improved
  double miss;  ///< before that, of the condition over 1; at most kFoamTolerance when done
};

/// One step towards the flow rule's root, from below. `drag` = eta/dt.
GS_ALWAYS_INLINE FoamIteration foam_step(const Foam& law, const FoamStress& trial, double drag, double x) {
  const Softness f = softness(law, trial, x);
  const double miss = 1.0 - law.strength * f.value - drag * x;
  return {x + miss / (law.strength * f.slope + drag), miss};
}

/// One step towards the end of the plateau, from above; `room` = r. A step that stays below r goes nowhere.
GS_ALWAYS_INLINE FoamIteration foam_lock_step(const Foam& law, const FoamStress& trial, double room, double x) {
  const Softness f = softness(law, trial, x);
  const double miss = x / room - f.value;
  // Where the tangent meets the line, not x less a step: the two may differ by all digits.
  const double met = (f.value - f.slope * x) / (1.0 / room - f.slope);
  return {miss > 0.0 ? met : x, miss / f.value};
}

/// Stress at the end of the step.
GS_ALWAYS_INLINE Stress relaxed(const Foam& law, const Stress& trial, double x) {
  const double p = mean(trial) / (1.0 + (3.0 * law.elastic.lambda + 2.0 * law.elastic.mu) * x);
  const double scale = 1.0 / (1.0 + 2.0 * law.elastic.mu * x);
  const Stress d = deviator(trial);
  return {p + scale * d.xx, p + scale * d.yy, scale * d.xy, p + scale * d.zz};
}

}  // namespace grainstep::fe
