#include "engine.hpp"

#include <liggghts/atom.h>
#include <liggghts/atom_vec.h>
#include <liggghts/error.h>
#include <liggghts/lammps.h>
#include <liggghts/library.h>
#include <liggghts/modify.h>

#include <algorithm>
#include <base/error.hpp>
#include <dem-service/mpi_start.hpp>
#include <map>
#include <sstream>

#include "surface_fix.hpp"

namespace {

struct Failure {
  std::string text;
};

/// Throws what LIGGGHTS has found as an exception that says so.
template <typename Work>
void guarded(const std::string& where, Work&& work) {
  try {
    work();
  } catch (const Failure& failure) {
    throw grainstep::NumericalError("LIGGGHTS, " + where + ": " + failure.text);
  }
}

// Modify keeps the table of styles to itself, and LIGGGHTS has no other way to add one. Only an explicit instantiation
// may name a private member.
using FixTable = std::map<std::string, LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS*, int, char**)>;
FixTable& fix_table(LAMMPS_NS::Modify& modify);
template <FixTable* LAMMPS_NS::Modify::*Member>
struct Opened {
  friend FixTable& fix_table(LAMMPS_NS::Modify& modify) { return *(modify.*Member); }
};
template struct Opened<&LAMMPS_NS::Modify::fix_map>;

LAMMPS_NS::Fix* make_surface_fix(LAMMPS_NS::LAMMPS* liggghts, int count, char** words) {
  return new SurfaceFix(liggghts, count, words);  // owned by LIGGGHTS's list of fixes
}

}  // namespace

// LIGGGHTS ends the process where it finds an error. The program's own definitions take precedence over the shared
// library's, for its internal calls as well.
namespace LAMMPS_NS {
void Error::all(const char* /*file*/, int /*line*/, const char* text) { throw Failure{text}; }
void Error::one(const char* /*file*/, int /*line*/, const char* text) { throw Failure{text}; }
void Error::universe_all(const char* /*file*/, int /*line*/, const char* text) { throw Failure{text}; }
void Error::universe_one(const char* /*file*/, int /*line*/, const char* text) { throw Failure{text}; }
}  // namespace LAMMPS_NS

template <typename... Parts>
void Engine::command(const Parts&... parts) {
  std::ostringstream text;
  text.precision(17);
  (text << ... << parts);
  guarded("at `" + text.str() + "`", [&] { lammps_command(handle_, text.str().c_str()); });
}

Engine::Engine(const grainstep::dem::SlugModel& model, const std::vector<grainstep::dem::PlacedParticle>& particles,
               const std::string& log)
    : model_(model) {
  grainstep::dem::start_mpi();
  std::vector<std::string> words{"grainstep-liggghts", "-log", log.empty() ? "none" : log, "-screen", "none"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  guarded("when it was started",
          [&] { lammps_open(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_SELF, &handle_); });
  if (handle_ == nullptr) throw grainstep::NumericalError("LIGGGHTS could not be started");
  liggghts_ = static_cast<LAMMPS_NS::LAMMPS*>(handle_);
  make_box(particles);
  make_particles(particles);
}

Engine::~Engine() { lammps_close(handle_); }

// The box grows with the particles, but never gets smaller than it is now.
void Engine::make_box(const std::vector<grainstep::dem::PlacedParticle>& particles) {
  grainstep::surface::Vec3 low = particles.front().position;
  grainstep::surface::Vec3 high = low;
  for (const auto& particle : particles) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], particle.position[c]);
      high[c] = std::max(high[c], particle.position[c]);
    }
  }
  const double room = 2.0 * model_.largest();
  const double beside = model_.spheres() ? room : room / 2.0;
  command("units si");
  command("atom_style granular");
  command("atom_modify map array");
  command("dimension ", model_.spheres() ? 3 : 2);
  command(model_.spheres() ? "boundary m m m" : "boundary m m p");
  command("newton off");
  command("communicate single vel yes");
  command("region slug block ", low[0] - room, " ", high[0] + room, " ", low[1] - room, " ", high[1] + room, " ",
          low[2] - beside, " ", high[2] + beside, " units box");
  command("create_box 1 slug");
}

void Engine::make_particles(const std::vector<grainstep::dem::PlacedParticle>& particles) {
  LAMMPS_NS::Atom& atom = *liggghts_->atom;
  for (const auto& particle : particles) {
    double x[3] = {particle.position[0], particle.position[1], particle.position[2]};
    atom.avec->create_atom(1, x);
    const int i = atom.nlocal - 1;
    const double diameter = particle.diameter > 0.0 ? particle.diameter : model_.diameter;
    atom.tag[i] = i + 1;
    atom.radius[i] = diameter / 2.0;
    atom.rmass[i] = model_.mass_of(diameter);
    atom.density[i] = model_.density;
    for (int c = 0; c < 3; ++c) atom.v[i][c] = particle.velocity[c];
    atom.omega[i][2] = particle.spin;
  }
  atom.natoms = atom.nlocal;
  atom.map_init();
  atom.map_set();
}

// LIGGGHTS's own law is that of the scene: a spring and a dashpot along the normal, a spring with a slider
// tangentially.
void Engine::set_laws(const Settings& settings) {
  const grainstep::contact::ContactLaw law = grainstep::dem::calibrated_pair_law(model_, settings.dt);
  const auto property = [this](const char* name, double value) {
    command("fix ", name, " all property/global ", name, " peratomtypepair 1 ", value);
  };
  property("kn", law.normal_stiffness);
  property("kt", law.tangential_stiffness);
  property("gamman", law.damping_rate);
  property("gammat", 0.0);
  property("coefficientFriction", law.friction);
  command("pair_style gran model hooke/stiffness tangential history tangential_damping off");
  command("pair_coeff * *");
  command("neighbor ", settings.skin, " bin");
  command("neigh_modify delay 0 every 1 check yes");
  command("timestep ", settings.dt);
  command("fix motion all nve/sphere");
  command("thermo_modify lost ignore");  // the driver counts them, and says what it means
}

void Engine::run(int steps, const Settings& settings, grainstep::dem::StepDriver& driver,
                 grainstep::dem::Exchange& exchange) {
  set_laws(settings);
  fix_table(*liggghts_->modify)[SurfaceFix::style_name] = make_surface_fix;
  command("fix surface all ", SurfaceFix::style_name);
  LAMMPS_NS::Modify& modify = *liggghts_->modify;
  auto& fix = dynamic_cast<SurfaceFix&>(*modify.fix[modify.find_fix("surface")]);
  fix.connect(driver, exchange, grainstep::dem::calibrated_pair_law(model_, settings.dt));
  try {
    command("run ", steps, " post no");
  } catch (const SurfaceFix::Ended&) {  // LIGGGHTS knows no other way to end a run early
  }
}
