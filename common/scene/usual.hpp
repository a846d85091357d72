/// @file Values that can be computed but are hardly meant: a wrong prefix, a forgotten unit. Warnings, never errors.
#pragma once

#include <vector>

#include "scene/rules.hpp"

namespace grainstep::scene {

/// By each key's own declaration (Key.usual_from and usual_to), and where it takes two keys to see it.
void check_usual(const Scene& scene, std::vector<Finding>& findings);

}  // namespace grainstep::scene
