#include "dem-service/native/engine.hpp"

#include <limits>
#include <utility>

#include "base/error.hpp"
#include "dem-service/native/run.hpp"

namespace grainstep::dem::native {
namespace {

template <int D>
class EngineOf final : public Engine {
 public:
  EngineOf(const SlugModel& model, wire::ImpactorSetup setup, int threads, std::vector<PlacedParticle> particles)
      : model_(model), setup_(std::move(setup)), threads_(threads), particles_(std::move(particles)) {}

  void run(const wire::Start& start, participant::ImpactorLink& link) override {
    Run<D>(model_, setup_, start, link, watch_, threads_, particles_).run();
  }

 private:
  SlugModel model_;
  wire::ImpactorSetup setup_;
  int threads_;
  std::vector<PlacedParticle> particles_;
};

}  // namespace

std::unique_ptr<Engine> make_engine(const SlugModel& model, const wire::ImpactorSetup& setup,
                                    std::vector<PlacedParticle> particles, int threads) {
  if (particles.size() > std::numeric_limits<std::int32_t>::max()) {
    throw InputError("impactor.slug: more than 2^31 particles");
  }
  SlugModel of_these = model;
  of_these.particles = particles.size();
  if (model.spheres()) return std::make_unique<EngineOf<3>>(of_these, setup, threads, std::move(particles));
  return std::make_unique<EngineOf<2>>(of_these, setup, threads, std::move(particles));
}

}  // namespace grainstep::dem::native
