/// @file Where a slug's particles are and how fast they move at t = 0.
#pragma once

#include <vector>

#include "dem-service/slug/model.hpp"
#include "surface/polyline.hpp"

namespace grainstep::dem {

/// One particle at the start.
struct PlacedParticle {
  surface::Vec3 position;  ///< m; the third component is zero in the plane
  surface::Vec3 velocity;  ///< m/s, likewise
  double spin = 0.0;       ///< 1/s, about x3
  double diameter = 0.0;   ///< m; 0: the slug's mean
};

/// Packs the slug's block at random, the largest particles first, turns it by its angle about the middle of its leading
/// face, and lets it stand `stand_off` above first touch of the surface. Speeds are linear from head to tail. A slice
/// of a slug of spheres stands upright about the x2 axis. Throws InputError.
[[nodiscard]] std::vector<PlacedParticle> lay_out(const SlugModel& model, const surface::Polyline& surface);

}  // namespace grainstep::dem
