/// @file Sandwich core, equations (3.4) to (3.9): isotropic elasticity and uncoupled viscoplastic strains of the stress
/// components in the material frame (2: transverse), here the four that plane strain leaves: 11, 22, 33 and shear 12.
///     ep_dot_i = (|s_i| - Y_i)/eta  if |s_i| > Y_i, else 0, with the sign of s_i                              (3.6)
/// All Y_i = sigma_c (an option gives shear another one), but transversely in compression
///     Y_2 = sigma_c + E_t max(0, c - c_D),  c = -ep_2, the compaction (logarithmic; it falls when the core is pulled
///     open).
/// (3.9) gives densification as a nominal strain eps_D. Our choice: c_D = -ln(1 - eps_D); the literal c_D = eps_D is an
/// option. In tension Y_2 is what the compaction at the beginning of the step makes of it.
///
/// A step is backward Euler. With x_i the plastic increments and C the elastic stiffness,
///     s = s_trial - C x,   x_i = dt/eta <|s_i| - Y_i(c + ...)> sign(s_i)
/// are the conditions of a minimum of a strictly convex function of x (C is positive definite, each Y_i does not fall
/// with x_i), so the solution exists and is unique at any dt and eta, 0 included, and minimising along one x_i after
/// the other (Gauss and Seidel's sweep) converges to it from anywhere. Each of these minima is explicit.
#pragma once

#include "fe-service/materials/elastic.hpp"

namespace grainstep::scene {
class Structure;
}

namespace grainstep::fe {

/// After the stress: transverse compressive plastic strain, and the direction of the material axes.
enum CoreComponent : int { kCompaction = kStressState, kAxisCosine, kAxisSine, kCoreState };

struct Core {
  Elastic elastic;
  double strength;   ///< sigma_c, Pa
  double densified;  ///< c_D, logarithmic
  double tangent;    ///< E_t, Pa
  double viscosity;  ///< eta, Pa s
  double shear;      ///< strength in shear, Pa

  static constexpr LawTraits kTraits = {
      .word = "core", .state = kCoreState, .flow = kCompaction, .keeps_volume = true, .seconds = 1.0 / 80e6};
  using Memory = FullMemory;

  /// Throws InputError where the layer cannot be a core (material.cpp).
  static Core from(const scene::Structure& structure, int index);

  [[nodiscard]] GS_ALWAYS_INLINE const Elastic& elasticity() const { return elastic; }
  /// eta/dt.
  [[nodiscard]] GS_ALWAYS_INLINE double step_parameter(double step) const { return viscosity / step; }
  [[nodiscard]] double initial(int component) const { return component == kAxisCosine ? 1.0 : 0.0; }
};

/// Of the stress, relative.
inline constexpr double kCoreTolerance = 1e-12;
inline constexpr int kMaxCoreSweeps = 200;

/// Plastic strain increments in the material frame; engineering shear.
struct CoreFlowIncrement {
  double xx, yy, zz, gamma;
};

/// By how much s is beyond the interval [-strength, strength], with its sign.
GS_ALWAYS_INLINE double beyond(double s, double strength) {
  const double above = s > strength ? s - strength : 0.0;
  return s < -strength ? s + strength : above;
}

/// Part of Y_2 that compaction adds, Pa.
GS_ALWAYS_INLINE double densified_strength(const Core& law, double compaction) {
  return law.tangent * (compaction > law.densified ? compaction - law.densified : 0.0);
}

/// Transverse increment for the stress s that there would be without one, at `stiffness` = dS/dx + eta/dt.
GS_ALWAYS_INLINE double transverse_increment(const Core& law, double s, double compaction, double stiffness) {
  const double over = -s - law.strength;
  // Y_2 is the larger of two lines, so the increment is the smaller of two solutions.
  const double crushing = over / stiffness;
  const double densifying = (over - law.tangent * (compaction - law.densified)) / (stiffness + law.tangent);
  const double compression = crushing < densifying ? crushing : densifying;
  const double tension = (s - law.strength - densified_strength(law, compaction)) / stiffness;
  const double stretched = tension > 0.0 ? tension : 0.0;
  return compression > 0.0 ? -compression : stretched;
}

/// Shear is coupled to nothing.
GS_ALWAYS_INLINE double shear_increment(const Core& law, double trial, double drag) {
  return beyond(trial, law.shear) / (law.elastic.mu + drag);
}

/// One sweep over the normal components; `drag` = eta/dt. Returns the largest change, as a stress.
GS_ALWAYS_INLINE double sweep_core(const Core& law, const Stress& trial, double compaction, double drag,
                                   CoreFlowIncrement& x) {
  const double lambda = law.elastic.lambda;
  const double stiffness = law.elastic.longitudinal_modulus() + drag;
  const double xx = beyond(trial.xx - lambda * (x.yy + x.zz), law.strength) / stiffness;
  const double zz = beyond(trial.zz - lambda * (xx + x.yy), law.strength) / stiffness;
  const double yy = transverse_increment(law, trial.yy - lambda * (xx + zz), compaction, stiffness);
  const double change_xx = std::abs(xx - x.xx);
  const double change_yy = std::abs(yy - x.yy);
  const double change_zz = std::abs(zz - x.zz);
  x.xx = xx;
  x.yy = yy;
  x.zz = zz;
  const double larger = change_xx > change_yy ? change_xx : change_yy;
  return stiffness * (larger > change_zz ? larger : change_zz);
}

/// Whether nothing flows: then all increments are 0. Above 0: something does.
GS_ALWAYS_INLINE double core_overshoot(const Core& law, const Stress& trial, double compaction) {
  const double transverse = law.strength + densified_strength(law, compaction);
  const double xx = std::abs(trial.xx) - law.strength;
  const double zz = std::abs(trial.zz) - law.strength;
  const double xy = std::abs(trial.xy) - law.shear;
  const double yy = std::abs(trial.yy) - transverse;
  const double normal = xx > zz ? xx : zz;
  const double other = xy > yy ? xy : yy;
  return normal > other ? normal : other;
}

/// Scale of the tolerance, Pa.
GS_ALWAYS_INLINE double core_scale(const Core& law, const Stress& trial) {
  return law.strength + std::abs(trial.xx) + std::abs(trial.yy) + std::abs(trial.zz);
}

/// Stress at the end of the step.
GS_ALWAYS_INLINE Stress relaxed(const Core& law, const Stress& trial, const CoreFlowIncrement& x) {
  const Stress change = law.elastic.increment({x.xx, x.yy, x.gamma, x.zz});
  return {trial.xx - change.xx, trial.yy - change.yy, trial.xy - change.xy, trial.zz - change.zz};
}

}  // namespace grainstep::fe
