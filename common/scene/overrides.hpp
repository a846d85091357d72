/// @file --set PATH=VALUE
#pragma once

#include <string>

#include "scene/problems.hpp"
#include "scene/tree.hpp"

namespace grainstep::scene {

/// Applies "a.b.0.c=VALUE" to `root`: VALUE is YAML, a number among the names counts the items of a list (one past the
/// last appends), maps merge and everything else is replaced.
void apply_override(Tree& root, const std::string& text, Problems& problems);

}  // namespace grainstep::scene
