/// @file One constant-strain triangle (a, b, centre), counter-clockwise: its kinematics, its nodal forces and its
/// largest frequency. Vectors are relative to the centre node.
#pragma once

#include "fe-service/materials/elastic.hpp"

namespace grainstep::fe {

struct Vec2 {
  double x, y;
};

GS_ALWAYS_INLINE Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
GS_ALWAYS_INLINE Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
GS_ALWAYS_INLINE Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
GS_ALWAYS_INLINE double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
GS_ALWAYS_INLINE double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

struct TriangleMotion {
  double xx, yy, gamma;  ///< strain increment in the plane
  double half_tangent;   ///< tan of half the increment of rotation
  double twice_area;     ///< m^2, at the middle of the step
};

/// Increments over a step from the positions at its middle and the displacements during it. With gradients at the
/// middle, a finite rigid rotation gives no strain at all, and its spin increment W = 2 tan(theta/2) exactly.
GS_ALWAYS_INLINE TriangleMotion motion(Vec2 middle_a, Vec2 middle_b, Vec2 moved_a, Vec2 moved_b) {
  const double twice_area = cross(middle_a, middle_b);
  const double inverse = 1.0 / twice_area;
  const double xx = (moved_a.x * middle_b.y - moved_b.x * middle_a.y) * inverse;
  const double xy = (moved_b.x * middle_a.x - moved_a.x * middle_b.x) * inverse;
  const double yx = (moved_a.y * middle_b.y - moved_b.y * middle_a.y) * inverse;
  const double yy = (moved_b.y * middle_a.x - moved_a.y * middle_b.x) * inverse;
  return {xx, yy, xy + yx, 0.25 * (yx - xy), twice_area};
}

/// Half of stress . (d turned by -90 degrees), N/m: internal nodal forces of a unit thickness are made of it.
/// Node a of a triangle feels -traction(stress, b), node b feels +traction(stress, a), the centre the rest.
GS_ALWAYS_INLINE Vec2 traction(const Stress& s, Vec2 d) {
  return {0.5 * (s.xx * d.y - s.xy * d.x), 0.5 * (s.xy * d.y - s.yy * d.x)};
}

/// Largest eigenvalue of the stiffness matrix (unit thickness) in Pa. omega_max^2 = 3/(density x undeformed area) x
/// this, with a third of the mass at each node. Exact: in the principal axes of G = sum of grad N (x) grad N, shear
/// decouples, and tr G = S/(4 A^2), det G = 3/(4 A^2) with S the sum of the squared sides.
GS_ALWAYS_INLINE double largest_stiffness(const Elastic& law, Vec2 a, Vec2 b) {
  const double twice_area = cross(a, b);
  const Vec2 c = a - b;
  const double sides = dot(a, a) + dot(b, b) + dot(c, c);
  const double modulus = law.longitudinal_modulus();
  const double square = modulus * modulus * sides * sides -
                        12.0 * (modulus * modulus - law.lambda * law.lambda) * twice_area * twice_area;
  const double normal = modulus * sides + std::sqrt(square > 0.0 ? square : 0.0);
  const double shear = 2.0 * law.mu * sides;
  return (normal > shear ? normal : shear) / (4.0 * twice_area);
}

}  // namespace grainstep::fe
