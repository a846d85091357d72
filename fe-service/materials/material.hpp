/// @file The materials a layer may have. A new law is a struct in its own file, an entry here and a correct() in the
/// kernel.
#pragma once

#include <variant>

#include "fe-service/materials/core.hpp"
#include "fe-service/materials/dh36.hpp"
#include "fe-service/materials/foam.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::fe {

/// A foam is no layer of a structure: it is what a projectile is made of (foam/model.hpp).
using Material = std::variant<Elastic, Dh36, Core, Foam>;

/// Of structure.layers[layer]. Throws InputError for a material that this program does not know, and for a core that is
/// not one.
[[nodiscard]] Material make_material(const scene::Structure& structure, int layer);

[[nodiscard]] const Elastic& elastic_part(const Material& material);

}  // namespace grainstep::fe
