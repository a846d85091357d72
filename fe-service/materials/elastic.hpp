/// @file Isotropic linear elasticity in rate form: stress rate = lambda tr(D) I + 2 mu D.
#pragma once

#include "fe-service/materials/batch.hpp"

namespace grainstep::fe {

struct Elastic {
  double lambda;   ///< Lame's first parameter, Pa
  double mu;       ///< shear modulus G, Pa
  double density;  ///< kg/m^3, undeformed

  static constexpr LawTraits kTraits = {
      .word = "elastic", .state = kStressState, .flow = kNoFlow, .keeps_volume = true, .seconds = 1.0 / 200e6};
  using Memory = RadialMemory;

  static Elastic from_young(double young, double poisson, double density) {
    return {young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson)), density};
  }

  template <class Structure>
  static Elastic from(const Structure& structure, int index) {
    const auto& layer = structure.layers(index);
    return from_young(layer.young(), layer.poisson(), layer.density());
  }

  [[nodiscard]] GS_ALWAYS_INLINE const Elastic& elasticity() const { return *this; }
  [[nodiscard]] GS_ALWAYS_INLINE double step_parameter(double /*step*/) const { return 0.0; }
  [[nodiscard]] double initial(int /*component*/) const { return 0.0; }

  /// Modulus of a bar that cannot strain sideways, Pa; its square root over density is the fastest wave's speed.
  [[nodiscard]] GS_ALWAYS_INLINE double longitudinal_modulus() const { return lambda + 2.0 * mu; }

  [[nodiscard]] GS_ALWAYS_INLINE Stress increment(const StrainIncrement& e) const {
    const double volumetric = lambda * (e.xx + e.yy + e.zz);
    return {volumetric + 2.0 * mu * e.xx, volumetric + 2.0 * mu * e.yy, mu * e.gamma, volumetric + 2.0 * mu * e.zz};
  }

  /// Stored energy over volume, J/m^3: one half of stress : inverse stiffness : stress.
  [[nodiscard]] GS_ALWAYS_INLINE double stored_energy(const Stress& stress) const {
    const Stress s = deviator(stress);
    const double p = mean(stress);
    return contract(s, s) / (4.0 * mu) + 0.5 * p * p / (lambda + 2.0 / 3.0 * mu);
  }
};

GS_ALWAYS_INLINE void correct(const Elastic&, double*, const RadialMemory&, double, int, double*, RowOutcome&) {}

}  // namespace grainstep::fe
