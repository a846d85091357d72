/// @file A slug's particles at random places without overlap: random sequential addition.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/polyline.hpp"
#include "surface/vec.hpp"

namespace grainstep::dem {

/// Random sequential addition of equal discs jams near 0.547; towards it the work grows without bound.
inline constexpr double densest_random_packing = 0.53;
/// Of equal spheres it jams near 0.382.
inline constexpr double densest_random_packing_of_spheres = 0.35;

struct PackingBox {
  surface::Vec2 low;   ///< m, smallest coordinates of a centre
  surface::Vec2 high;  ///< m, largest
};

/// A slice 0 <= theta <= angle of a cylinder about the x2 axis; theta is counted from x1 to x3.
struct PackingSlice {
  double outer = 0.0;            ///< m, largest distance of a centre from the axis
  double low = 0.0, high = 0.0;  ///< m, smallest and largest x2 of a centre
  double angle = 0.0;            ///< rad, below pi
  double wall_gap = 0.0;         ///< m, smallest distance of a centre from the planes theta = 0 and theta = angle

  /// m: nearer to the axis the planes leave no place for a centre.
  [[nodiscard]] double inner() const;
};

/// Centres of `count` discs of one diameter (m), uniform in the box, no two closer than the diameter. The same seed
/// gives the same places on every machine. Throws InputError, naming the fraction reached, when they do not fit.
[[nodiscard]] std::vector<surface::Vec2> pack_at_random(const PackingBox& box, std::uint64_t count, double diameter,
                                                        std::uint64_t seed);

/// Likewise of spheres in a slice. Every ring of equal area between inner() and `outer` gets the same number, to one,
/// whatever share of it lies within `wall_gap` of the planes: what the slug weighs per area does not fall towards the
/// axis (docs/decisions/0012-slices-of-slugs.md).
[[nodiscard]] std::vector<surface::Vec3> pack_at_random(const PackingSlice& slice, std::uint64_t count, double diameter,
                                                        std::uint64_t seed);

}  // namespace grainstep::dem
