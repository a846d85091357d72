#include "fe-service/materials/material.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "scene/core.hpp"

namespace grainstep::fe {
namespace {

Core make_core(const scene::Structure& structure, int layer) {
  const scene::Layer& core = structure.layers(layer);
  const scene::Layer& face = structure.layers(0);
  const scene::Core& keys = structure.core();
  const double relative_density = scene::core_relative_density(structure, core);
  const double densified = scene::densification_strain(relative_density);
  if (!(densified > 0.0)) {
    throw InputError(fmt::format(
        "structure.layers[{}]: a core of relative density {:g} (over layers[0]) has no room to densify, for "
        "eps_D = 1 - 1.5 rho_c/rho_m; lower its density below {:g} kg/m^3",
        layer, relative_density, face.density() / 1.5));
  }
  if (!core.has_viscosity() || !keys.has_normalised_strength()) {
    throw InputError(
        fmt::format("structure.layers[{}]: a core needs structure.core.normalised_strength and a viscosity", layer));
  }
  const double strength = keys.normalised_strength() * relative_density * face.yield_strength();
  return {Elastic::from_young(relative_density * face.young(), keys.poisson(), core.density()),
          strength,
          keys.densification() == scene::Core::DENSIFICATION_LITERAL ? densified : -std::log(1.0 - densified),
          keys.densified_slope() * face.young(),
          core.viscosity(),
          keys.shear_ratio() * strength};
}

}  // namespace

Material make_material(const scene::Structure& structure, int index) {
  const scene::Layer& layer = structure.layers(index);
  const Elastic elastic = Elastic::from_young(layer.young(), layer.poisson(), layer.density());
  switch (layer.material()) {
    case scene::Layer::MATERIAL_ELASTIC:
      return elastic;
    case scene::Layer::MATERIAL_DH36:
      return Dh36{elastic,
                  layer.yield_strength(),
                  layer.hardening_factor(),
                  layer.hardening_exponent(),
                  layer.rate_factor(),
                  layer.reference_rate()};
    case scene::Layer::MATERIAL_CORE:
      return make_core(structure, index);
    default:
      throw InputError(
          fmt::format("structure.layers[{}].material: grainstep-fe knows `dh36`, `elastic` and `core`, found value "
                      "number {}",
                      index, static_cast<int>(layer.material())));
  }
}

const Elastic& elastic_part(const Material& material) {
  if (const auto* steel = std::get_if<Dh36>(&material)) return steel->elastic;
  if (const auto* core = std::get_if<Core>(&material)) return core->elastic;
  if (const auto* foam = std::get_if<Foam>(&material)) return foam->elastic;
  return std::get<Elastic>(material);
}

}  // namespace grainstep::fe
