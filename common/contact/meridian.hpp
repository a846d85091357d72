/// @file How the polyline of the surface stands in space: extruded along x3, or revolved about the x2 axis. There the
/// point of the surface closest to p lies in the half plane through the axis and p, so that one closest point in two
/// dimensions serves both.
#pragma once

#include <cmath>

#include "surface/vec.hpp"

namespace grainstep::contact {

enum class Shape { extruded, revolved };

/// The plane of the polyline that a point lies in, by the direction of its first axis in x1 and x3.
struct Meridian {
  double along_x1 = 1.0;
  double along_x3 = 0.0;

  [[nodiscard]] surface::Vec3 in_space(const surface::Vec2& a) const {
    return {{a[0] * along_x1, a[1], a[0] * along_x3}};
  }
  /// The part of `a` in the plane: what a ring can feel.
  [[nodiscard]] surface::Vec2 in_plane(const surface::Vec3& a) const {
    return {{a[0] * along_x1 + a[2] * along_x3, a[1]}};
  }
  /// Its part across the plane, along the circumference.
  [[nodiscard]] double across(const surface::Vec3& a) const { return a[2] * along_x1 - a[0] * along_x3; }
};

/// Where x (three coordinates, m) lies in its plane.
inline surface::Vec2 place_of(Shape shape, const double* x) {
  return {{shape == Shape::extruded ? x[0] : std::sqrt(x[0] * x[0] + x[2] * x[2]), x[1]}};
}

/// A point on the axis itself lies in every plane: it gets that of x1.
inline Meridian meridian_of(Shape shape, const double* x) {
  if (shape == Shape::extruded) return {};
  const double r = std::sqrt(x[0] * x[0] + x[2] * x[2]);
  return r > 0.0 ? Meridian{x[0] / r, x[2] / r} : Meridian{};
}

}  // namespace grainstep::contact
