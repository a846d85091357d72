/// @file A slug of grains from first to last window, in this process alone and without a library.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "contact/particle_arrays.hpp"
#include "dem-service/pair/pair.hpp"
#include "dem-service/slug/layout.hpp"
#include "participant/backend.hpp"

namespace grainstep::dem::native {

/// What a run shows whoever watches it, at every step when the forces are known: all grains, sleepers as well, and
/// those pairs of them that touch.
struct View {
  std::uint64_t step = 0;
  contact::ParticleArrays grains;
  std::span<const Pair> touching;
};
using Watch = std::function<void(const View& view)>;

class Engine {
 public:
  virtual ~Engine() = default;
  /// Runs all windows. Throws InputError, NumericalError or what the link throws.
  virtual void run(const wire::Start& start, participant::ImpactorLink& link) = 0;

  /// For tests: slows the run down.
  void watch(Watch watch) { watch_ = std::move(watch); }

 protected:
  Watch watch_;
};

/// Discs or spheres, as the model says. Results do not depend on the number of threads.
[[nodiscard]] std::unique_ptr<Engine> make_engine(const SlugModel& model, const wire::ImpactorSetup& setup,
                                                  std::vector<PlacedParticle> particles, int threads = 1);

}  // namespace grainstep::dem::native
