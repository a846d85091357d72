/// @file Whether a slug can be computed as its equivalent foam projectile.
#pragma once

#include <vector>

#include "scene/rules.hpp"

namespace grainstep::scene {

/// @pre the impactor is of type foam.
void check_foam(const Scene& scene, std::vector<Finding>& findings);

}  // namespace grainstep::scene
