/// @file A slug's particles at random places without overlap: random sequential addition.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/polyline.hpp"
#include "surface/vec.hpp"

namespace grainstep::dem {

/// Random sequential addition of equal discs jams near 0.547; towards it the work grows without bound.
inline constexpr double densest_random_packing = 0.53;

struct PackingBox {
  surface::Vec2 low;   ///< m, smallest coordinates of a centre
  surface::Vec2 high;  ///< m, largest
};

/// Centres of `count` discs of one diameter (m), uniform in the box, no two closer than the diameter. The same seed
/// gives the same places on every machine. Throws InputError, naming the fraction reached, when they do not fit.
[[nodiscard]] std::vector<surface::Vec2> pack_at_random(const PackingBox& box, std::uint64_t count, double diameter,
                                                        std::uint64_t seed);

}  // namespace grainstep::dem
