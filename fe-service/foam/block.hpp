/// @file A foam projectile as a body: where it is and how fast at t = 0, which nodes can touch, what holds it.
#pragma once

#include "fe-service/body.hpp"
#include "fe-service/foam/model.hpp"
#include "surface/polyline.hpp"

namespace grainstep::fe {

/// Turned by its angle about the middle of its leading face, at its speed, `stand_off` above first touch. Throws
/// InputError where nothing of it stands above the surface.
[[nodiscard]] Body make_block(const FoamModel& model, const surface::Polyline& surface);

/// Corner nodes on the block's outline, its plane or axis of symmetry left out: leading face, sides, tail.
[[nodiscard]] std::vector<std::size_t> outline(const Mesh& mesh);

/// What of the undeformed outline is each of its nodes', the integral of its shape function, m^2; as outline().
[[nodiscard]] std::vector<double> outline_areas(const Mesh& mesh, const Measure& measure);

/// kg, of the heaviest node of the leading face.
[[nodiscard]] double heaviest_of_face(const Body& body);

/// 2/omega_max of the block and its contact, s: `elements` is the block's own. A node in touch gains stiffness/mass of
/// omega^2; the lightest one for its stiffness is taken.
[[nodiscard]] double stable_step_in_touch(const FoamModel& model, const Body& body, double elements);

/// Stops what may not move: u1 on the plane or axis of symmetry, and on the sides of a confined block, which cling to
/// their frictionless walls. Returns the impulse, N s, that this gave.
Vec2 hold_block(const FoamModel& model, Body& body);

}  // namespace grainstep::fe
