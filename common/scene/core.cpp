#include "scene/core.hpp"

namespace grainstep::scene {

double core_relative_density(const Structure& structure, const Layer& core) {
  return core.density() / structure.layers(0).density();
}

double densification_strain(double relative_density) { return 1.0 - 1.5 * relative_density; }

double shock_viscosity(double width, double density, double speed, double densification_strain) {
  return width * density * speed / densification_strain;
}

void resolve_cores(Scene& scene) {
  if (!scene.impactor().has_slug()) return;
  Structure& structure = *scene.mutable_structure();
  for (Layer& layer : *structure.mutable_layers()) {
    if (layer.material() != Layer::MATERIAL_CORE || layer.has_viscosity()) continue;
    layer.set_viscosity(shock_viscosity(structure.core().shock_width() * layer.thickness(), layer.density(),
                                        scene.impactor().slug().speed(),
                                        densification_strain(core_relative_density(structure, layer))));
  }
}

}  // namespace grainstep::scene
