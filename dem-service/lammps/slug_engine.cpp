#include "dem-service/lammps/slug_engine.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "base/error.hpp"
#include "dem-service/lammps/adapter.hpp"
#include "dem-service/lammps/attach.hpp"
#include "dem-service/lammps/pair_style.hpp"
#include "dem-service/slug/preview.hpp"

namespace grainstep::dem {
namespace {

// Neighbour lists hold pairs up to this many diameters beyond contact. Long lists cost little, rebuilding them much:
// at 400 m/s a particle flies half a diameter in ten steps (docs/decisions/0001-how-lammps-is-driven.md).
constexpr double skin_in_diameters = 1.0;

std::string text_of(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string text_of(const char* format, ...) {
  char buffer[400];
  va_list values;
  va_start(values, format);
  std::vsnprintf(buffer, sizeof buffer, format, values);
  va_end(values);
  return buffer;
}

}  // namespace

SlugEngine::SlugEngine(const EngineOptions& options, const wire::Setup& setup)
    : SlugEngine(options, setup, lay_out(slug_model_of(setup), MovingSurface(setup.impactor().surface()).now())) {}

SlugEngine::SlugEngine(const EngineOptions& options, const wire::Setup& setup,
                       const std::vector<PlacedParticle>& particles)
    : model_(slug_model_of(setup)),
      communicator_(options.communicator),
      session_(options.communicator, options.lammps_log),
      setup_(setup.impactor()),
      ready_(preview(setup_.impactor(), setup.symmetry(), setup.depth(), setup.mirror()).ready(setup_.surface())) {
  model_.particles = particles.size();
  create_particles(particles);
}

void SlugEngine::create_particles(const std::vector<PlacedParticle>& particles) {
  if (particles.size() > std::numeric_limits<int>::max()) throw InputError("impactor.slug: more than 2^31 particles");
  const double room = 2.0 * model_.largest();
  surface::Vec3 low = particles.front().position;
  surface::Vec3 high = low;
  std::vector<int> identity(particles.size());
  std::vector<double> position;
  std::vector<double> velocity;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const PlacedParticle& particle = particles[i];
    identity[i] = static_cast<int>(i + 1);
    position.insert(position.end(), particle.position.c.begin(), particle.position.c.end());
    velocity.insert(velocity.end(), particle.velocity.c.begin(), particle.velocity.c.end());
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], particle.position[c]);
      high[c] = std::max(high[c], particle.position[c]);
    }
  }
  // The box grows with the particles, but never gets smaller than it is now: LAMMPS refuses one much thinner than the
  // neighbour cutoff, which a single row of particles would make. Ranks share it along x1, so that all have their part
  // of the front.
  const bool spheres = model_.spheres();
  for (const char* line : {"units si", "atom_style sphere", spheres ? "dimension 3" : "dimension 2", "newton on",
                           spheres ? "boundary m m m" : "boundary m m p", "comm_modify vel yes", "processors * 1 1"}) {
    session_.command(line);
  }
  const double beside = spheres ? room : room / 2.0;
  session_.command(text_of("region slug block %.17g %.17g %.17g %.17g %.17g %.17g units box", low[0] - room,
                           high[0] + room, low[1] - room, high[1] + room, low[2] - beside, high[2] + beside));
  session_.command("create_box 1 slug");
  session_.create_particles({.identity = identity, .position = position, .velocity = velocity});
  const lammps::Particles made = lammps::particles_of(session_.lammps());
  for (int i = 0; i < made.owned; ++i) {
    const PlacedParticle& particle = particles[static_cast<std::size_t>(made.identity[i] - 1)];
    const double diameter = particle.diameter > 0.0 ? particle.diameter : model_.diameter;
    made.radius[i] = diameter / 2.0;
    made.mass[i] = model_.mass_of(diameter);
    made.spin[i][2] = particle.spin;
  }
}

void SlugEngine::set_laws(const ContactLaw& pair, double dt, double skin) {
  PairStyle::register_style(session_.lammps());
  session_.command(text_of("pair_style %s %.17g %.17g %.17g %.17g", PairStyle::style_name, pair.normal_stiffness,
                           pair.tangential_stiffness, pair.damping_rate, pair.friction));
  session_.command("pair_coeff * *");
  lammps::find_pair<PairStyle>(session_.lammps()).damp_by_mass(pair.damping_table);
  session_.command(text_of("neighbor %.17g bin", skin));
  session_.command(text_of("neigh_modify delay 0 every 1 check yes binsize %.17g", model_.largest() + skin));
  session_.command(text_of("timestep %.17g", dt));
  session_.command(model_.spheres() ? "fix motion all nve/sphere" : "fix motion all nve/sphere disc");
  int ranks = 1;
  MPI_Comm_size(communicator_, &ranks);
  if (ranks > 1) session_.command("fix shares all balance 500 1.1 shift x 10 1.05");
  session_.command("timer loop");
  session_.command("thermo_modify lost ignore");  // we count them ourselves and say what it means
}

void SlugEngine::run(const wire::Start& start, participant::ImpactorLink* link) {
  require_drivable(start);
  const double dt = start.window() / start.impactor_steps();
  const double skin = skin_in_diameters * model_.diameter;
  set_laws(calibrated_pair_law(model_, dt), dt, skin);
  drive({.session = session_,
         .communicator = communicator_,
         .model = model_,
         .surface = setup_.surface(),
         .settings = {dt, skin / 2.0}},
        start, link);
}

}  // namespace grainstep::dem
