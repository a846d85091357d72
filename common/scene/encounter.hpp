/// @file Whether what flies meets what stands: beside it, in time, and stiff enough to turn round.
#pragma once

#include <vector>

#include "scene/rules.hpp"

namespace grainstep::scene {

/// @pre a scene with a slug (has_slug).
void check_encounter(const Scene& scene, std::vector<Finding>& findings);

}  // namespace grainstep::scene
