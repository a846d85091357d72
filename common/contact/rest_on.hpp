/// @file First touch: what hits is put where it just touches the surface.
#pragma once

#include <span>
#include <vector>

#include "surface/polyline.hpp"

namespace grainstep::contact {

/// Lowers (or raises) all discs together until the first one just touches the surface: the smallest gap is zero but for
/// round-off, and never negative. `radii`, m: one for each disc, or one for all. Throws InputError when no disc stands
/// above the surface.
void rest_on(const surface::Polyline& surface, std::span<const double> radii, std::vector<surface::Vec2>& centres);

}  // namespace grainstep::contact
