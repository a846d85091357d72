/// @file The laws of a scene's layers (law.hpp says how to add one).
#pragma once

#include <string>
#include <vector>

#include "fe-service/materials/laws.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::fe {

/// Of structure.layers[layer]. Throws InputError for a material that this program does not know, and for a core that is
/// not one.
[[nodiscard]] Material make_material(const scene::Structure& structure, int layer);

/// Words of structure.layers[].material that this program knows.
[[nodiscard]] std::vector<std::string> layer_words();

[[nodiscard]] const Elastic& elastic_part(const Material& material);
[[nodiscard]] const LawTraits& traits_of(const Material& material);

}  // namespace grainstep::fe
