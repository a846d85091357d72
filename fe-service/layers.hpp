/// @file The scene's layers as materials.
#pragma once

#include <vector>

#include "fe-service/bulk_viscosity.hpp"
#include "fe-service/materials/material.hpp"

namespace grainstep::fe {

[[nodiscard]] inline std::vector<Material> make_layers(const scene::Structure& structure) {
  std::vector<Material> layers;
  layers.reserve(static_cast<std::size_t>(structure.layers_size()));
  for (int i = 0; i < structure.layers_size(); ++i) {
    layers.push_back(make_material(structure, i));
  }
  return layers;
}

[[nodiscard]] inline BulkFactors bulk_factors(const scene::Structure& structure) {
  return {structure.bulk_viscosity().linear(), structure.bulk_viscosity().quadratic()};
}

}  // namespace grainstep::fe
