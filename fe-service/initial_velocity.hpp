/// @file Velocities at t = 0, from the scene's fields (structure.initial_velocity).
#pragma once

#include "fe-service/body.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::fe {

/// Gives a body at rest its fields' velocities. An element that a field covers in part gets that part of its momentum,
/// so the momentum of a field is exact on any mesh; it is shared among the element's nodes as its mass is. What is held
/// (clamps, the plane of symmetry) stays at rest: the share of its nodes is not given at all.
void set_initial_velocity(const scene::Structure& structure, Body& body);

/// m/s: momentum of all fields over mass, of a structure that moves as a whole. (Along x1 of a solid of revolution:
/// the mean of the velocity along r.)
[[nodiscard]] Vec2 mean_initial_velocity(const scene::Structure& structure, const Measure& measure);

}  // namespace grainstep::fe
