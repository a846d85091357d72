#include "dem-service/surface_fix.hpp"

#include <lammps/atom.h>
#include <lammps/lammps.h>
#include <lammps/modify.h>
#include <lammps/timer.h>
#include <lammps/update.h>

#include <algorithm>

#include "base/assert.hpp"
#include "dem-service/pair/style.hpp"

namespace grainstep::dem {
namespace {

LAMMPS_NS::Fix* create(LAMMPS_NS::LAMMPS* lammps, int argument_count, char** arguments) {
  return new SurfaceFix(lammps, argument_count, arguments);  // owned by LAMMPS's list of fixes
}

constexpr int spring_values = 3;

}  // namespace

void SurfaceFix::register_style(LAMMPS_NS::LAMMPS& lammps) { (*lammps.modify->fix_map)[style_name] = &create; }

SurfaceFix& SurfaceFix::find(LAMMPS_NS::LAMMPS& lammps, const char* id) {
  const int index = lammps.modify->find_fix(id);
  GS_ASSERT(index >= 0, std::string("no fix ") + id);
  auto* fix = dynamic_cast<SurfaceFix*>(lammps.modify->fix[index]);
  GS_ASSERT(fix != nullptr, std::string("another style of fix ") + id);
  return *fix;
}

SurfaceFix::SurfaceFix(LAMMPS_NS::LAMMPS* lammps, int argument_count, char** arguments)
    : Fix(lammps, argument_count, arguments) {
  nevery = 1;
  create_attribute = 1;
  maxexchange = spring_values;
  SurfaceFix::grow_arrays(atom->nmax);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
}

SurfaceFix::~SurfaceFix() { atom->delete_callback(id, LAMMPS_NS::Atom::GROW); }

void SurfaceFix::connect(StepDriver& driver, RankExchange& exchange) {
  driver_ = &driver;
  exchange_ = &exchange;
}

int SurfaceFix::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return POST_NEIGHBOR | PRE_FORCE | POST_FORCE | END_OF_STEP;
}

ParticleArrays SurfaceFix::particles() {
  return {.owned = atom->nlocal,
          .position = atom->x,
          .velocity = atom->v,
          .spin = atom->omega,
          .force = atom->f,
          .torque = atom->torque,
          .radius = atom->radius,
          .mass = atom->rmass,
          .identity = atom->tag,
          .spring = springs_.data()};
}

std::uint64_t SurfaceFix::step() const { return static_cast<std::uint64_t>(update->ntimestep); }

/// LAMMPS knows nothing of our exceptions, and other ranks wait for this one: keep it for the next exchange.
template <typename Work>
void SurfaceFix::guarded(Work&& work) {
  try {
    work();
  } catch (...) {
    exchange_->fail_with_current_exception();
  }
  if (driver_->ended()) timer->force_timeout();
}

void SurfaceFix::post_neighbor() {
  guarded([&] { driver_->rebuild(particles()); });
}

void SurfaceFix::pre_force(int /*flags*/) {
  guarded([&] { driver_->before_pair_forces(step(), particles()); });
}

void SurfaceFix::post_force(int /*flags*/) {
  guarded([&] { driver_->after_pair_forces(step(), particles()); });
}

void SurfaceFix::setup(int flags) {
  post_force(flags);
  end_of_step();
}

void SurfaceFix::end_of_step() {
  guarded([&] { driver_->end_of_step(step(), particles(), PairStyle::find(*lmp).energy()); });
}

void SurfaceFix::grow_arrays(int capacity) { springs_.resize(static_cast<std::size_t>(capacity)); }

void SurfaceFix::copy_arrays(int from, int to, int /*delete_flag*/) { springs_[to] = springs_[from]; }

void SurfaceFix::set_arrays(int i) { springs_[i] = {}; }

int SurfaceFix::pack_exchange(int i, double* buffer) {
  std::copy_n(springs_[i].c.begin(), spring_values, buffer);
  return spring_values;
}

int SurfaceFix::unpack_exchange(int i, double* buffer) {
  std::copy_n(buffer, spring_values, springs_[i].c.begin());
  return spring_values;
}

double SurfaceFix::memory_usage() { return static_cast<double>(springs_.capacity() * sizeof(surface::Vec3)); }

}  // namespace grainstep::dem
