/// @file PATH=VALUE: of --set on the command line, or of a `set:` list in a study.
#pragma once

#include <string>

#include "declare/problems.hpp"
#include "declare/tree.hpp"

namespace grainstep::declare {

struct Override {
  std::string text;
  Origin origin{"--set", 0};  ///< for messages
};

/// Applies "a.b.0.c=VALUE" to `root`: VALUE is YAML, a number among the names counts the items of a list (one past the
/// last appends), maps merge and everything else is replaced.
void apply_override(Tree& root, const Override& override, Problems& problems);

}  // namespace grainstep::declare
