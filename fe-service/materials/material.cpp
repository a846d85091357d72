#include "fe-service/materials/material.hpp"

#include "base/error.hpp"

namespace grainstep::fe {

Material make_material(const scene::Layer& layer, const std::string& where) {
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
    default:
      throw InputError(where + ".material: grainstep-fe knows `dh36` and `elastic`, found value number " +
                       std::to_string(layer.material()));
  }
}

const Elastic& elastic_part(const Material& material) {
  if (const auto* steel = std::get_if<Dh36>(&material)) return steel->elastic;
  return std::get<Elastic>(material);
}

}  // namespace grainstep::fe
