/// @file Flow strength of DH36 steel, equation (3.3):
///     sigma_Y(ep, rate) = Y [1 + A ep^n] [1 + C ln(rate/rate0)],   Y = 470 MPa, A = 1.5, n = 0.4, C = 0.015, rate0 =
///     1/s,
/// which is Johnson-Cook's law without temperature. The factor of the rate is 1 below rate0: our choice, for (3.3)
/// would fall below zero there.
#pragma once

#include <cmath>

#include "fe-service/materials/elastic.hpp"

namespace grainstep::fe {

struct Dh36 {
  Elastic elastic;
  double yield_strength;      ///< Y, Pa
  double hardening_factor;    ///< A
  double hardening_exponent;  ///< n, in (0, 1]
  double rate_factor;         ///< C
  double reference_rate;      ///< rate0, 1/s

  static constexpr LawTraits kTraits = {
      .word = "dh36", .state = kRadialState, .flow = kPlasticStrain, .keeps_volume = true, .seconds = 1.0 / 80e6};
  using Memory = RadialMemory;

  template <class Structure>
  static Dh36 from(const Structure& structure, int index) {
    const auto& layer = structure.layers(index);
    return {Elastic::from(structure, index), layer.yield_strength(), layer.hardening_factor(),
            layer.hardening_exponent(),      layer.rate_factor(),    layer.reference_rate()};
  }

  [[nodiscard]] GS_ALWAYS_INLINE const Elastic& elasticity() const { return elastic; }
  /// ln(dt rate0). Without dependence on rate, one that no increment reaches: the return must not take another path,
  /// and round off otherwise, for a reference rate that means nothing.
  [[nodiscard]] GS_ALWAYS_INLINE double step_parameter(double step) const {
    constexpr double never = 1e3;
    return rate_factor > 0.0 ? std::log(step * reference_rate) : never;
  }
  [[nodiscard]] double initial(int component) const { return component == kStaticStrength ? yield_strength : 0.0; }

  /// Y [1 + A ep^n], Pa, for ep > 0 (its limit at ep = 0 is Y).
  [[nodiscard]] GS_ALWAYS_INLINE double static_strength(double plastic_strain) const {
    return yield_strength * (1.0 + hardening_factor * std::exp(hardening_exponent * std::log(plastic_strain)));
  }

  /// 1 + C ln(rate/rate0), at least 1; the argument is ln(rate/rate0).
  [[nodiscard]] GS_ALWAYS_INLINE double rate_multiplier(double log_rate_ratio) const {
    return 1.0 + rate_factor * (log_rate_ratio > 0.0 ? log_rate_ratio : 0.0);
  }
};

}  // namespace grainstep::fe
