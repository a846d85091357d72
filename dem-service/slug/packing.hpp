/// @file A slug's particles at random places without overlap: random sequential addition.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/polyline.hpp"
#include "surface/vec.hpp"

namespace grainstep::dem {

/// Random sequential addition of equal discs jams near 0.547; towards it the work grows without bound. Unequal ones,
/// the largest first, fit in more easily.
inline constexpr double densest_random_packing = 0.53;
/// Of equal spheres it jams near 0.382.
inline constexpr double densest_random_packing_of_spheres = 0.35;

/// What discs are to lie in.
struct PackingBox {
  surface::Vec2 low;   ///< m
  surface::Vec2 high;  ///< m
};

/// A slice 0 <= theta <= angle of a cylinder about the x2 axis; theta is counted from x1 to x3.
struct PackingSlice {
  double outer = 0.0;            ///< m, its radius
  double low = 0.0, high = 0.0;  ///< m, x2 of its ends
  double angle = 0.0;            ///< rad, below pi

  /// m: nearer to the axis the planes theta = 0 and theta = angle leave no place for the centre of such a sphere.
  [[nodiscard]] double inner(double radius) const;
};

/// Centres of discs of these diameters (m, the largest first), each uniform where it has room in the box, none
/// overlapping. The same seed gives the same places on every machine. Throws InputError, naming the fraction reached,
/// when they do not fit.
[[nodiscard]] std::vector<surface::Vec2> pack_at_random(const PackingBox& box, std::span<const double> diameters,
                                                        std::uint64_t seed);

/// Likewise of spheres in a slice. Of the rings of equal area into which the places of its size can be divided every
/// sphere is given another one, whatever share of it lies within a radius of the planes: what the slug weighs per area
/// does not fall towards the axis (docs/decisions/0012-slices-of-slugs.md).
[[nodiscard]] std::vector<surface::Vec3> pack_at_random(const PackingSlice& slice, std::span<const double> diameters,
                                                        std::uint64_t seed);

}  // namespace grainstep::dem
