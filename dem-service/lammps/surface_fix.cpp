#include "dem-service/lammps/surface_fix.hpp"

#include <algorithm>

#include "base/archive.hpp"
#include "dem-service/lammps/pair_style.hpp"

namespace grainstep::dem {
namespace {

constexpr int spring_values = 3;

}  // namespace

SurfaceFix::SurfaceFix(lammps::Instance* lammps, int argument_count, char** arguments)
    : ParticleFix(lammps, argument_count, arguments) {
  nevery = 1;
  maxexchange = spring_values;
  SurfaceFix::grow_arrays(capacity());
  follow_particles();
}

void SurfaceFix::connect(StepDriver& driver, Exchange& exchange, bool own_pair_style) {
  driver_ = &driver;
  exchange_ = &exchange;
  own_pair_style_ = own_pair_style;
  first_step_ = step();
}

int SurfaceFix::setmask() {
  using namespace lammps::turns;
  return POST_NEIGHBOR | PRE_FORCE | POST_FORCE | END_OF_STEP;
}

ParticleArrays SurfaceFix::arrays() {
  const lammps::Particles now = particles();
  return {.owned = now.owned,
          .position = now.position,
          .velocity = now.velocity,
          .spin = now.spin,
          .force = now.force,
          .torque = now.torque,
          .radius = now.radius,
          .mass = now.mass,
          .identity = now.identity,
          .spring = springs_.data()};
}

/// LAMMPS knows nothing of our exceptions, and other ranks wait for this one: keep it for the next exchange.
template <typename Work>
void SurfaceFix::guarded(Work&& work) {
  if (waits_) return;
  try {
    work();
  } catch (...) {
    exchange_->fail_with_current_exception();
  }
  if (driver_->ended()) end_run();
}

void SurfaceFix::post_neighbor() {
  guarded([&] { driver_->rebuild(arrays()); });
}

void SurfaceFix::pre_force(int /*flags*/) {
  guarded([&] { driver_->before_pair_forces(step() - first_step_, arrays()); });
}

void SurfaceFix::post_force(int /*flags*/) {
  guarded([&] { driver_->after_pair_forces(step() - first_step_, arrays()); });
}

void SurfaceFix::setup(int flags) {
  post_force(flags);
  end_of_step();
}

void SurfaceFix::end_of_step() {
  guarded([&] {
    const PairEnergy pairs = own_pair_style_ ? lammps::find_pair<PairStyle>(instance()).energy() : PairEnergy{};
    driver_->end_of_step(step() - first_step_, arrays(), pairs);
    if (driver_->state_is_wanted(step() - first_step_)) exchange_->send_state(state());
  });
}

template <class Archive>
void SurfaceFix::serialize(Archive& archive, lammps::Moment& moment) {
  archive("LAMMPS", moment);
  if constexpr (Archive::loads) lammps::list_again(instance(), moment);
  std::vector<surface::Vec3> springs(springs_.begin(), springs_.begin() + particles().owned);
  archive.fixed("springs", springs);
  std::copy(springs.begin(), springs.end(), springs_.begin());
  archive("contacts between particles", lammps::find_pair<PairStyle>(instance()).contacts());
  archive("driver", *driver_);
}

std::string SurfaceFix::state() {
  base::Saving archive;
  lammps::Moment moment = lammps::moment_of(instance());
  serialize(archive, moment);
  return archive.take();
}

/// Contacts are read where neighbours were listed; particles are put where they are when all has been read.
void SurfaceFix::go_on_from(std::string_view state) {
  base::Loading archive(state);
  lammps::Moment moment;
  lammps::find_fix<PairFix>(instance(), PairFix::fix_id).forget();
  serialize(archive, moment);
  archive.end();
  lammps::go_on_from(instance(), moment);
  waits_ = false;
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
