/// @file What structure.bulk_viscosity is there for (docs/decisions/0014-bulk-viscosity.md). SI.
#pragma once

#include "grainstep/scene.pb.h"
#include "scene/rules.hpp"

namespace grainstep::scene {

/// A front that rises over more elements than these does not ring: plastic strain behind it is right within 2%.
inline constexpr double elements_of_a_sudden_front = 10.0;

/// Whether a prescribed pressure changes by more than some layer's yield strength within the time in which an elastic
/// wave passes elements_of_a_sudden_front: elements ring under it, and flow too much.
[[nodiscard]] bool strikes_suddenly(const Scene& scene);

/// Refuses factors that nobody would read; warns where elements would ring.
void check_bulk_viscosity(const Scene& scene, std::vector<Finding>& findings);

}  // namespace grainstep::scene
