#include "surface_fix.hpp"

#include <liggghts/atom.h>
#include <liggghts/force.h>
#include <liggghts/neighbor.h>
#include <liggghts/pair_gran.h>
#include <liggghts/update.h>

#include <algorithm>

using grainstep::surface::Vec3;

SurfaceFix::SurfaceFix(LAMMPS_NS::LAMMPS* liggghts, int argument_count, char** arguments)
    : Fix(liggghts, argument_count, arguments) {
  nevery = 1;
  create_attribute = 1;
  SurfaceFix::grow_arrays(atom->nmax);
  atom->add_callback(0);
}

SurfaceFix::~SurfaceFix() { atom->delete_callback(id, 0); }

void SurfaceFix::connect(grainstep::dem::StepDriver& driver, grainstep::dem::Exchange& exchange,
                         const grainstep::contact::ContactLaw& law) {
  driver_ = &driver;
  exchange_ = &exchange;
  books_.emplace(law);
}

int SurfaceFix::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return PRE_FORCE | POST_FORCE | END_OF_STEP;
}

std::uint64_t SurfaceFix::step() const { return static_cast<std::uint64_t>(update->ntimestep); }

grainstep::contact::ParticleArrays SurfaceFix::arrays() {
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

/// What goes wrong is kept for the conversation, which ends the run at its next exchange.
template <typename Work>
void SurfaceFix::guarded(Work&& work) {
  try {
    work();
  } catch (...) {
    exchange_->fail_with_current_exception();
  }
  if (driver_->ended()) throw Ended{};
}

void SurfaceFix::setup_pre_force(int /*flags*/) {
  guarded([&] {
    driver_->rebuild(arrays());
    driver_->before_pair_forces(step(), arrays());
  });
}

// LIGGGHTS has no turn of its own after its lists were built anew: it counts the steps since.
void SurfaceFix::pre_force(int /*flags*/) {
  guarded([&] {
    if (neighbor->ago == 0) driver_->rebuild(arrays());
    driver_->before_pair_forces(step(), arrays());
  });
}

void SurfaceFix::post_force(int /*flags*/) {
  guarded([&] {
    books_->add(dynamic_cast<LAMMPS_NS::PairGran&>(*force->pair), *this, *atom, step() == 0 ? 0.0 : update->dt);
    driver_->after_pair_forces(step(), arrays());
  });
}

void SurfaceFix::setup(int flags) {
  post_force(flags);
  end_of_step();
}

void SurfaceFix::end_of_step() {
  guarded([&] { driver_->end_of_step(step(), arrays(), books_->energy()); });
}

bool SurfaceFix::history_args(char** names_and_flags) {
  ContactBooks::name_values(names_and_flags);
  return true;
}

void SurfaceFix::grow_arrays(int capacity) { springs_.resize(static_cast<std::size_t>(capacity)); }

void SurfaceFix::copy_arrays(int from, int to, int /*delete_flag*/) { springs_[to] = springs_[from]; }

void SurfaceFix::set_arrays(int i) { springs_[i] = {}; }

int SurfaceFix::pack_exchange(int i, double* buffer) {
  std::copy_n(springs_[i].c.begin(), 3, buffer);
  return 3;
}

int SurfaceFix::unpack_exchange(int i, double* buffer) {
  std::copy_n(buffer, 3, springs_[i].c.begin());
  return 3;
}
