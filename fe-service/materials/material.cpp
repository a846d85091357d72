#include "fe-service/materials/material.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "declare/declaration.hpp"
#include "declare/suggest.hpp"
#include "scene/core.hpp"

namespace grainstep::fe {

Core Core::from(const scene::Structure& structure, int layer) {
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

namespace {

template <class... Law>
std::vector<std::string> words(LawList<Law...>) {
  std::vector<std::string> found;
  for (const char* word : {Law::kTraits.word...}) {
    if (word != nullptr) found.emplace_back(word);
  }
  return found;
}

/// Makes the law if the layer's word is its own.
template <class Law>
void make_if(const std::string& word, const scene::Structure& structure, int index, std::optional<Material>& found) {
  if constexpr (Law::kTraits.word != nullptr) {
    if (word == Law::kTraits.word) found = Law::from(structure, index);
  }
}

template <class... Law>
std::optional<Material> make(LawList<Law...>, const std::string& word, const scene::Structure& structure, int index) {
  std::optional<Material> found;
  (make_if<Law>(word, structure, index, found), ...);
  return found;
}

}  // namespace

std::vector<std::string> layer_words() { return words(Laws{}); }

Material make_material(const scene::Structure& structure, int index) {
  const int number = static_cast<int>(structure.layers(index).material());
  const std::string word = declare::word_for(*scene::Layer::Material_descriptor(), number);
  if (const auto found = make(Laws{}, word, structure, index)) return *found;
  throw InputError(fmt::format("structure.layers[{}].material: grainstep-fe knows {}, found {}", index,
                               declare::join_words(layer_words()),
                               word.empty() ? fmt::format("value number {}", number) : word));
}

const Elastic& elastic_part(const Material& material) {
  return std::visit([](const auto& law) -> const Elastic& { return law.elasticity(); }, material);
}

const LawTraits& traits_of(const Material& material) {
  return std::visit([](const auto& law) -> const LawTraits& { return law.kTraits; }, material);
}

}  // namespace grainstep::fe
