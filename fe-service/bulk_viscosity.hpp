/// @file Bulk viscosity: a pressure against the rate of volume, which smears fronts over some elements
/// (docs/theory/structure.md).
#pragma once

namespace grainstep::fe {

/// The scene's keys structure.bulk_viscosity. Zero: none.
struct BulkFactors {
  double linear = 0.0;     ///< b_1
  double quadratic = 0.0;  ///< b_2

  [[nodiscard]] bool any() const { return linear > 0.0 || quadratic > 0.0; }
};

/// What a row's elements resist with.
struct BulkViscosity {
  double density;       ///< rho, kg/m^3, undeformed
  double linear_speed;  ///< b_1 c_d, m/s
  double quadratic;     ///< b_2^2
};

}  // namespace grainstep::fe
