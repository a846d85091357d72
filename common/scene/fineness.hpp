/// @file The key that says how finely a side is computed: what to change where it takes too much memory or time.
#pragma once

#include <string>

#include "grainstep/scene.pb.h"

namespace grainstep::scene {

struct Fineness {
  std::string key;
  bool finer_is_larger = false;  ///< its number grows with the work
};

[[nodiscard]] inline Fineness fineness_of(const Impactor& impactor) {
  if (impactor.type() == Impactor::TYPE_FOAM) return {.key = "impactor.foam.elements", .finer_is_larger = true};
  return {.key = "impactor.slug.particle.diameter"};
}

[[nodiscard]] inline Fineness fineness_of(const Structure& /*meshed*/) {
  return {.key = "structure.mesh.refinement", .finer_is_larger = true};
}

}  // namespace grainstep::scene
