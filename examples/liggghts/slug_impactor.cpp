#include "slug_impactor.hpp"

#include <base/error.hpp>
#include <contact/moving_surface.hpp>
#include <dem-service/slug/exchange.hpp>
#include <dem-service/slug/layout.hpp>
#include <dem-service/slug/preview.hpp>
#include <dem-service/slug/step_driver.hpp>
#include <limits>
#include <participant/hello.hpp>
#include <surface/disc_overlap.hpp>
#include <utility>

#include "engine.hpp"

using grainstep::InputError;
using grainstep::contact::MovingSurface;
namespace dem = grainstep::dem;
namespace wire = grainstep::wire;

namespace {

constexpr double time_over_lammps = 2.0;  // of a step, with the contacts' books: measured on the quick scene

// Neighbour lists reach this many diameters beyond contact: at 400 m/s a particle flies half of one in ten steps.
constexpr double skin_in_diameters = 1.0;

}  // namespace

SlugImpactor::SlugImpactor(std::string log) : log_(std::move(log)) {}
SlugImpactor::~SlugImpactor() = default;

wire::Hello SlugImpactor::describe() const {
  wire::Hello hello = grainstep::participant::hello(wire::IMPACTOR, "grainstep-liggghts (LIGGGHTS)", "1", {2});
  // LIGGGHTS has one damping rate for a pair of types: particles of many sizes would need one for each pair of masses.
  for (const char* word : {"slug", "plane_strain", "axisymmetric", "tension_cutoff"}) hello.add_capabilities(word);
  return hello;
}

wire::Ready SlugImpactor::prepare(const wire::Setup& setup) {
  if (!setup.has_impactor()) {
    throw InputError("setup: grainstep-liggghts is an impactor, but was sent a structure's part");
  }
  const wire::ImpactorSetup& part = setup.impactor();
  wire::Ready ready =
      dem::preview(part.impactor(), setup.symmetry(), setup.depth(), setup.mirror()).ready(part.surface());
  ready.set_scene_hash(setup.scene_hash());
  ready.set_seconds_per_step(time_over_lammps * ready.seconds_per_step());
  if (setup.preview()) return ready;
  model_ = dem::make_slug_model(part.impactor(), setup.symmetry(), setup.depth(), setup.mirror());
  surface_ = part.surface();
  const MovingSurface surface(surface_);
  dem::meet(model_, part.impactor().slug().surface_contact(), part.free_mass(),
            grainstep::surface::mean_length(surface.now()));
  engine_ = std::make_unique<Engine>(model_, dem::lay_out(model_, surface.now()), log_);
  return ready;
}

void SlugImpactor::run(const wire::Start& start, grainstep::participant::ImpactorLink& link) {
  if (start.first_window() != 0) {
    throw InputError("grainstep-liggghts cannot continue a run: Start.first_window must be 0");
  }
  const std::uint64_t steps = start.windows() * start.impactor_steps();
  if (steps > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
    throw InputError("time.end: " + std::to_string(steps) + " steps, but LIGGGHTS runs up to 2^31: end earlier");
  }
  const double dt = start.window() / start.impactor_steps();
  const double skin = skin_in_diameters * model_.diameter;
  MovingSurface surface(surface_);
  dem::Exchange exchange(&link, surface.node_count());
  dem::StepDriver driver(model_, start, {.dt = dt, .margin = skin / 2.0}, std::move(surface), exchange);
  engine_->run(static_cast<int>(steps), {.dt = dt, .skin = skin}, driver, exchange);
  exchange.finish();
}
