/// @file What makes volume out of a plane element's area. The element loop is a template over it.
#pragma once

#include "fe-service/always_inline.hpp"

namespace grainstep::fe {

/// Plane strain: depth b everywhere, no strain along x3.
struct PlaneStrain {
  double depth;  ///< b, m

  /// Volume over area, m, for a triangle whose centroid is at x1.
  [[nodiscard]] GS_ALWAYS_INLINE double thickness(double /*x1*/) const { return depth; }

  /// Increment of the strain along x3 of a triangle whose centroid is at x1 and moves by u1.
  [[nodiscard]] GS_ALWAYS_INLINE double out_of_plane_increment(double /*x1*/, double /*u1*/) const { return 0.0; }
};

}  // namespace grainstep::fe
