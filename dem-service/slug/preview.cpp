#include "dem-service/slug/preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/number_text.hpp"
#include "contact/moving_surface.hpp"
#include "dem-service/slug/model.hpp"
#include "participant/hello.hpp"
#include "surface/disc_overlap.hpp"

namespace grainstep::dem {
namespace {

// Measured on one core of 2020s server hardware: per particle and step, mean over an event, 40 to 43 ns with 8 and with
// 31 thousand particles, 68 with 191 thousand beside other programs (docs/accuracy.md). Spheres: 51 ns with 6250 of
// them (configs/small/plate-monolithic.yaml), 77 with 50 thousand (bench/README.md). Beyond some number they no longer
// fit into the caches; 12.5 ns per factor e describes both.
struct Dynamics {
  double seconds, in_cache;  ///< per particle and step, of so many particles
};
constexpr Dynamics of_discs{4.5e-8, 31'000};
constexpr Dynamics of_spheres{5.1e-8, 6'250};
constexpr double seconds_beyond_cache = 1.25e-8;

double seconds_of_dynamics(const SlugModel& model) {
  const Dynamics& one = model.spheres() ? of_spheres : of_discs;
  const double times = static_cast<double>(model.particles) / one.in_cache;
  return one.seconds + seconds_beyond_cache * std::log(std::max(1.0, times));
}

constexpr std::uint64_t bytes_of_program = 60'000'000;
constexpr std::uint64_t bytes_per_particle = 1'500;  // LAMMPS arrays, neighbour lists with histories
constexpr std::uint64_t bytes_per_sphere = 2'400;    // over a whole event, with a snapshot on its way (bench/README.md)
// What a neighbour list as long as that of equal particles has in it; it reaches as far as two of the largest want it.
// Measured with two sizes of ratio 3 by mass, 3.5 times as long: 5 ns more than equal discs on the same machine.
constexpr double bytes_of_list = 100.0;
constexpr double seconds_of_list = 2e-9;

/// Over that of equal particles of the same mean diameter.
double length_of_list(const SlugModel& model) {
  const int k = model.spheres() ? 3 : 2;
  return std::pow(0.5 * (1.0 + model.sizes.largest()), k) / model.sizes.mean_of_power(k);
}

/// What a dent under one particle depends on, if its force acts at a point (docs/theory/contact.md).
std::optional<std::string> warning_of_dents(const SlugPreview& slug, const wire::Surface& surface) {
  if (!slug.point_contact || surface.facet().empty()) return std::nullopt;
  const double elements = slug.largest / mean_length(contact::MovingSurface(surface).now());
  if (!(elements > widest_point_contact)) return std::nullopt;
  return "impactor.slug.surface_contact.spreading: point: a particle is as wide as " + rounded_text(elements) +
         " elements of the surface, and the dent under it will follow the mesh, with its plastic work and the rebound. "
         "Write chord (auto takes it from " +
         rounded_text(widest_point_contact) + " on), or a coarser mesh";
}

}  // namespace

SlugPreview preview(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth, bool mirror) {
  const SlugModel model = make_slug_model(impactor, symmetry, depth, mirror);
  SlugPreview preview;
  preview.particles = model.particles;
  preview.particle_mass = model.mass;
  preview.mass = model.mass_of_all();
  preview.smallest = model.smallest();
  preview.largest = model.largest();
  preview.contact_mass = model.whole() * model.mass_of(model.largest());
  preview.contact_time = model.contact_time;
  preview.stable_step = model.stable_step;
  preview.preferred_step = model.preferred_step;
  preview.process_bytes = bytes_of_program;
  const double more = length_of_list(model) - 1.0;
  const auto lists = static_cast<std::uint64_t>(more * bytes_of_list * static_cast<double>(model.particles));
  preview.memory_bytes =
      bytes_of_program + (model.spheres() ? bytes_per_sphere : bytes_per_particle) * model.particles + lists;
  preview.seconds_per_particle_step = seconds_of_dynamics(model) + more * seconds_of_list;
  preview.point_contact = impactor.slug().surface_contact().spreading() == scene::SurfaceContact::SPREADING_POINT;
  return preview;
}

wire::Ready SlugPreview::ready(const wire::Surface& surface) const {
  wire::Ready out;
  out.set_size(particles);
  out.set_counted("particles");
  out.set_ledger(wire::FULL);
  out.set_mass(mass);
  out.set_contact_mass(contact_mass);
  out.set_contact_time(contact_time);
  out.set_stable_step(stable_step);
  out.set_preferred_step(preferred_step);
  out.set_memory(memory_bytes);
  out.set_rank_memory(process_bytes);
  out.set_seconds_per_step(static_cast<double>(particles) * seconds_per_particle_step);
  out.set_largest_particle(largest);
  participant::add_fact(
      out, "particles",
      fmt::format("{}, stable step {:.4g} s, contact time {:.4g} s", particles, stable_step, contact_time));
  if (largest > smallest) {
    participant::add_fact(out, "diameters", fmt::format("{:.4g} to {:.4g} mm", 1e3 * smallest, 1e3 * largest));
  }
  if (const auto warning = warning_of_dents(*this, surface)) out.add_warning(*warning);
  return out;
}

}  // namespace grainstep::dem
