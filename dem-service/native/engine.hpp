/// @file A slug of grains from first to last window, in this process alone and without a library.
#pragma once

#include <memory>

#include "dem-service/slug_layout.hpp"
#include "participant/backend.hpp"

namespace grainstep::dem::native {

class Engine {
 public:
  virtual ~Engine() = default;
  /// Runs all windows. Throws InputError, NumericalError or what the link throws.
  virtual void run(const wire::Start& start, participant::ImpactorLink& link) = 0;
};

/// Discs or spheres, as the model says.
[[nodiscard]] std::unique_ptr<Engine> make_engine(const SlugModel& model, const wire::ImpactorSetup& setup,
                                                  std::vector<PlacedParticle> particles);

}  // namespace grainstep::dem::native
