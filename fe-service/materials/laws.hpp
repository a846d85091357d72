/// @file The list of material laws: the only place that names them all (law.hpp says how to add one).
#pragma once

#include <variant>

#include "fe-service/materials/core.hpp"
#include "fe-service/materials/core_flow.hpp"
#include "fe-service/materials/dh36.hpp"
#include "fe-service/materials/elastic.hpp"
#include "fe-service/materials/foam.hpp"
#include "fe-service/materials/foam_flow.hpp"
#include "fe-service/materials/radial_flow.hpp"

namespace grainstep::fe {

template <class... Law>
struct LawList {
  using Variant = std::variant<Law...>;
  template <template <class...> class Template>
  using Apply = Template<Law...>;
};

using Laws = LawList<Elastic, Dh36, Core, Foam>;

/// A foam is no layer of a structure: it is what a projectile is made of (foam/model.hpp).
using Material = Laws::Variant;

}  // namespace grainstep::fe
