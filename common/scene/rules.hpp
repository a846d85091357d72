/// @file Rules between several keys of a scene, which no single key's declaration can say and which need no solver.
/// What depends on a backend (packing limit, mesh, stable steps) is checked by that backend.
#pragma once

#include <string>
#include <vector>

#include "grainstep/scene.pb.h"

namespace grainstep::scene {

enum class Severity { error, warning };

struct Finding {
  Severity severity = Severity::error;
  std::string path;  ///< of the key that one would change
  std::string text;  ///< what was found, what was expected
};

/// @pre every key is present and within its own range. load_scene() turns errors into an InputError; warnings are for
/// whoever shows the scene to people.
[[nodiscard]] std::vector<Finding> check_rules(const Scene& scene);

}  // namespace grainstep::scene
