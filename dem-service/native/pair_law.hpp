/// @file What contacts between grains need to know of a slug.
#pragma once

#include "dem-service/pair/batch.hpp"
#include "dem-service/slug/model.hpp"

namespace grainstep::dem::native {

/// The table stays the law's.
inline PairLaw pair_law(const ContactLaw& law) {
  return {.normal_stiffness = law.normal_stiffness,
          .tangential_stiffness = law.tangential_stiffness,
          .damping_rate = law.damping_rate,
          .friction = law.friction,
          .damping_table = law.damping_table.get()};
}

template <int D>
PairFeatures features_of(const SlugModel& model) {
  return {.dimension = D,
          .friction = model.pair_law.friction > 0.0 && model.pair_law.tangential_stiffness > 0.0,
          .energy = true,
          .mixed = !model.sizes.equal()};
}

}  // namespace grainstep::dem::native
