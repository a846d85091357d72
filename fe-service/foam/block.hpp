/// @file A foam projectile as a body: where it is and how fast at t = 0, which nodes can touch, what holds it.
#pragma once

#include "fe-service/body.hpp"
#include "fe-service/foam/model.hpp"
#include "surface/polyline.hpp"

namespace grainstep::fe {

/// Turned by its angle about the middle of its leading face, at its speed, `stand_off` above first touch. Throws
/// InputError where nothing of it stands above the surface.
[[nodiscard]] Body make_block(const FoamModel& model, const surface::Polyline& surface);

/// Corner nodes on the block's outline, its plane of symmetry left out: leading face, sides, tail.
[[nodiscard]] std::vector<std::size_t> outline(const Mesh& mesh);

/// Stops what may not move: u1 on the plane of symmetry, and on the sides of a confined block, which cling to their
/// frictionless walls. Returns the impulse, N s, that this gave.
Vec2 hold_block(const FoamModel& model, Body& body);

}  // namespace grainstep::fe
