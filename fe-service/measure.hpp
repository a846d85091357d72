/// @file What makes a solid of a plane element: the element loop is a template over it. x1 is the span in plane strain
/// and the radius r about the axis x1 = 0 in a solid of revolution, where x3 is the hoop direction.
#pragma once

#include <numbers>
#include <variant>

#include "fe-service/always_inline.hpp"

namespace grainstep::fe {

/// Plane strain: depth b everywhere, no strain along x3.
struct PlaneStrain {
  double depth;  ///< b, m

  /// Whether the stress along x3 makes nodal forces.
  static constexpr bool kHoops = false;

  /// Whether the four triangles of a quad have one dilatation, the mean of theirs. Here they need not: of their four
  /// volumes, which plastic flow keeps, one follows from the others, so that crossed triangles do not lock.
  static constexpr bool kSharesDilatation = false;

  /// Volume over area, m, for a triangle whose centroid is at x1.
  [[nodiscard]] GS_ALWAYS_INLINE double thickness(double /*x1*/) const { return depth; }

  /// Increment of the strain along x3 of a triangle whose centroid is at x1 and moves by u1.
  [[nodiscard]] GS_ALWAYS_INLINE double out_of_plane_increment(double /*x1*/, double /*u1*/) const { return 0.0; }

  /// Thickness, m, that the mass which an undeformed quad of four crossed triangles gives to a corner goes by: that
  /// mass is a sixth of density x area x this. `centre` and `corner` are their x1.
  [[nodiscard]] GS_ALWAYS_INLINE double corner_thickness(double /*centre*/, double /*corner*/) const { return depth; }
};

/// Solid of revolution, the full circle. With a constant stress in the element, its virtual power
///     2 pi integral of (sigma : D + sigma_33 v_r/r) r dA = 2 pi A (r_c sigma : D + sigma_33 v_c)
/// is exact, r_c and v_c being those of the centroid: r is linear, and so is v_r. Hence hoop strain rate v_c/r_c, which
/// is finite at the axis too, and a third of 2 pi A sigma_33 for each node.
struct Axisymmetric {
  static constexpr bool kHoops = true;

  /// The volumes of four rings are independent: a volume each for two displacements per corner and two per centre, and
  /// pressures that run away from one another. One volume per quad leaves flow free (docs/decisions). A foam's flow
  /// keeps no volume: its triangles keep their own (kernel/sweep.hpp).
  static constexpr bool kSharesDilatation = true;

  [[nodiscard]] GS_ALWAYS_INLINE double thickness(double r) const { return 2.0 * std::numbers::pi * r; }
  [[nodiscard]] GS_ALWAYS_INLINE double out_of_plane_increment(double r, double u) const { return u / r; }
  /// What the stress along x3 pulls each node of a triangle towards the axis with, N.
  [[nodiscard]] GS_ALWAYS_INLINE double hoop_pull(double stress, double twice_area) const {
    return std::numbers::pi / 3.0 * stress * twice_area;
  }
  /// The integral of the node's shape function over the quad, which is a sixth of area x 2 pi (r_centre + r_corner)/2.
  [[nodiscard]] GS_ALWAYS_INLINE double corner_thickness(double centre, double corner) const {
    return std::numbers::pi * (centre + corner);
  }
};

/// Chosen once for a body.
using Measure = std::variant<PlaneStrain, Axisymmetric>;

[[nodiscard]] inline bool is_of_revolution(const Measure& measure) {
  return std::holds_alternative<Axisymmetric>(measure);
}

[[nodiscard]] inline double thickness(const Measure& measure, double x1) {
  return std::visit([x1](const auto& m) { return m.thickness(x1); }, measure);
}

[[nodiscard]] inline double corner_thickness(const Measure& measure, double centre, double corner) {
  return std::visit([=](const auto& m) { return m.corner_thickness(centre, corner); }, measure);
}

}  // namespace grainstep::fe
