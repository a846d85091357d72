/// @file Stress and strain increment of a plane element: components 11, 22, 12 and 33 (x3 out of the plane). Tension is
/// positive, stress in Pa.
#pragma once

#include <cmath>

#include "fe-service/always_inline.hpp"

namespace grainstep::fe {

struct Stress {
  double xx, yy, xy, zz;
};

struct StrainIncrement {
  double xx, yy, gamma, zz;  ///< gamma: engineering shear, 2 x the tensor component
};

GS_ALWAYS_INLINE double mean(const Stress& s) { return (s.xx + s.yy + s.zz) * (1.0 / 3.0); }

GS_ALWAYS_INLINE Stress deviator(const Stress& s) {
  const double p = mean(s);
  return {s.xx - p, s.yy - p, s.xy, s.zz - p};
}

/// Full contraction a : b.
GS_ALWAYS_INLINE double contract(const Stress& a, const Stress& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * a.xy * b.xy;
}

/// Von Mises equivalent stress sqrt(3/2 s:s), in Pa.
GS_ALWAYS_INLINE double von_mises(const Stress& stress) {
  const Stress s = deviator(stress);
  return std::sqrt(1.5 * contract(s, s));
}

/// Rotates by the angle theta about x3, given tan(theta/2) (Hughes and Winget 1980: R = (I - W/2)^-1 (I + W/2), which
/// is an exact rotation whatever the spin increment W).
GS_ALWAYS_INLINE Stress rotate(const Stress& s, double half_tangent) {
  const double t2 = half_tangent * half_tangent;
  const double scale = 1.0 / (1.0 + t2);
  const double c = (1.0 - t2) * scale;
  const double d = 2.0 * half_tangent * scale;
  const double cos2 = c * c - d * d;
  const double sin2 = 2.0 * c * d;
  const double centre = 0.5 * (s.xx + s.yy);
  const double radius = 0.5 * (s.xx - s.yy);
  const double turned = radius * cos2 - s.xy * sin2;
  return {centre + turned, centre - turned, radius * sin2 + s.xy * cos2, s.zz};
}

}  // namespace grainstep::fe
