#include "dem-service/preview.hpp"

#include "dem-service/slug_model.hpp"

namespace grainstep::dem {
namespace {

// Measured on one core of 2020s server hardware: per particle and step, mean over an event, 40 to 43 ns with 8 and with
// 31 thousand particles, 68 with 191 thousand beside other programs (docs/accuracy.md). Spheres: 51 ns with 6250 of
// them (configs/small/plate-monolithic.yaml).
constexpr double seconds_of_dynamics = 4.5e-8;
constexpr std::uint64_t bytes_of_program = 60'000'000;
constexpr std::uint64_t bytes_per_particle =
    1'500;  // LAMMPS arrays, neighbour lists with histories (spheres: 900 loose, 1200 compacted)

}  // namespace

ImpactorPreview preview(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth, bool mirror) {
  const SlugModel model = make_slug_model(impactor, symmetry, depth, mirror);
  ImpactorPreview preview;
  preview.particles = model.particles;
  preview.particle_mass = model.mass;
  preview.contact_mass = model.whole() * model.mass_of(model.largest());
  preview.contact_time = model.contact_time;
  preview.stable_step = model.stable_step;
  preview.preferred_step = model.preferred_step;
  preview.process_bytes = bytes_of_program;
  preview.memory_bytes = bytes_of_program + bytes_per_particle * model.particles;
  preview.seconds_per_particle_step = seconds_of_dynamics;
  return preview;
}

}  // namespace grainstep::dem
