/// @file The materials a layer may have. A new law is a struct in its own file, an entry here and a correct() in the
/// kernel.
#pragma once

#include <string>
#include <variant>

#include "fe-service/materials/dh36.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::fe {

using Material = std::variant<Elastic, Dh36>;

/// Throws InputError for a material that this program does not know; `where` is the layer's path in the scene.
[[nodiscard]] Material make_material(const scene::Layer& layer, const std::string& where);

[[nodiscard]] const Elastic& elastic_part(const Material& material);

}  // namespace grainstep::fe
