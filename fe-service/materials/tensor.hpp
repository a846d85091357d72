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

/// Turns by the angle whose double has this cosine and sine.
GS_ALWAYS_INLINE Stress turned(const Stress& s, double cos2, double sin2) {
  const double centre = 0.5 * (s.xx + s.yy);
  const double radius = 0.5 * (s.xx - s.yy);
  const double across = radius * cos2 - s.xy * sin2;
  return {centre + across, centre - across, radius * sin2 + s.xy * cos2, s.zz};
}

/// Rotates by the angle theta about x3, given tan(theta/2) (Hughes and Winget 1980: R = (I - W/2)^-1 (I + W/2), which
/// is an exact rotation whatever the spin increment W).
GS_ALWAYS_INLINE Stress rotate(const Stress& s, double half_tangent) {
  const double t2 = half_tangent * half_tangent;
  const double scale = 1.0 / (1.0 + t2);
  const double c = (1.0 - t2) * scale;
  const double d = 2.0 * half_tangent * scale;
  return turned(s, c * c - d * d, 2.0 * c * d);
}

/// Rotates by theta/2: what has come up in the middle of a step turns with its second half only. Without it the update
/// is of first order where a body spins while it strains.
GS_ALWAYS_INLINE Stress rotate_from_middle(const Stress& s, double half_tangent) {
  const double t2 = half_tangent * half_tangent;
  const double scale = 1.0 / (1.0 + t2);
  return turned(s, (1.0 - t2) * scale, 2.0 * half_tangent * scale);
}

}  // namespace grainstep::fe
