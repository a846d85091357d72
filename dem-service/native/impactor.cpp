#include "dem-service/native/impactor.hpp"

#include "base/assert.hpp"
#include "base/error.hpp"
#include "contact/moving_surface.hpp"
#include "declare/ranges.hpp"
#include "dem-service/native/engine.hpp"
#include "dem-service/slug/preview.hpp"
#include "participant/hello.hpp"

namespace grainstep::dem::native {
namespace {

// Over what LAMMPS takes for the same particles and steps: `bench_dem_step`, 0.29 (spreading) to 0.39 (compaction).
constexpr double time_over_lammps = 0.35;
// Largest resident size of the process in runs of 2 to 31 thousand particles, with a snapshot on its way.
constexpr std::uint64_t bytes_of_program = 12'000'000;
constexpr std::uint64_t bytes_per_disc = 800;
constexpr std::uint64_t bytes_per_sphere = 1'600;

void make_own(wire::Ready& ready, bool spheres) {
  ready.set_seconds_per_step(time_over_lammps * ready.seconds_per_step());
  ready.set_memory(bytes_of_program + ready.size() * (spheres ? bytes_per_sphere : bytes_per_disc));
  ready.set_rank_memory(bytes_of_program);
}

class Impactor final : public participant::ImpactorBackend {
 public:
  explicit Impactor(int threads) : threads_(threads) {}

  [[nodiscard]] wire::Hello describe() const override {
    wire::Hello hello = participant::hello(wire::IMPACTOR, "grainstep-grains (native)", GRAINSTEP_VERSION, {2});
    for (const char* word :
         {"slug", "plane_strain", "axisymmetric", "size_distribution", "tension_cutoff", "threads", "state"})
      hello.add_capabilities(word);
    return hello;
  }

  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    if (!setup.has_impactor()) {
      throw InputError("setup: grainstep-grains is an impactor, but was sent a structure's part");
    }
    const scene::Impactor& impactor = setup.impactor().impactor();
    if (impactor.type() != scene::Impactor::TYPE_SLUG) {
      throw InputError("impactor.type: grainstep-grains computes `slug`, this scene has another one");
    }
    declare::require_ranges(impactor, "impactor");
    wire::Ready ready =
        preview(impactor, setup.symmetry(), setup.depth(), setup.mirror()).ready(setup.impactor().surface());
    make_own(ready, setup.symmetry() == scene::SYMMETRY_AXISYMMETRIC);
    ready.set_scene_hash(setup.scene_hash());
    if (setup.preview()) return ready;
    const SlugModel model = slug_model_of(setup);
    engine_ = make_engine(model, setup.impactor(),
                          lay_out(model, contact::MovingSurface(setup.impactor().surface()).now()), threads_);
    return ready;
  }

  void run(const wire::Start& start, participant::ImpactorLink& link) override {
    GS_ASSERT(engine_ != nullptr, "run() before prepare()");
    engine_->run(start, link);
  }

 private:
  int threads_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace

std::unique_ptr<participant::ImpactorBackend> make_impactor(int threads) { return std::make_unique<Impactor>(threads); }

}  // namespace grainstep::dem::native
