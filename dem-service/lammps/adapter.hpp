/// @file All that the engine knows of LAMMPS's C++ classes, in one place: their headers, their tables of styles, their
/// arrays, how a run is ended. They are no stable interface and differ between versions (cmake/GrainstepLammps.cmake
/// says which are known); with another one, this file and session.cpp are what has to be looked at. The rest of
/// the engine sees these bases and views only, and commands in LAMMPS's own language (LammpsSession::command).
///
/// Everything is inline: a step goes through some of it.
#pragma once

// LAMMPS's C++ headers were written for an older fmt than Debian's: this is the one name that they miss. The templates
// that use it are never instantiated here.
#include <fmt/format.h>
namespace fmt {
template <typename... Args, typename Text>
format_args make_args_checked(const Text& text, const Args&... values);
}

#include <lammps/atom.h>
#include <lammps/comm.h>
#include <lammps/domain.h>
#include <lammps/error.h>
#include <lammps/fix.h>
#include <lammps/force.h>
#include <lammps/input.h>
#include <lammps/lammps.h>
#include <lammps/memory.h>
#include <lammps/modify.h>
#include <lammps/neigh_list.h>
#include <lammps/neighbor.h>
#include <lammps/pair.h>
#include <lammps/timer.h>
#include <lammps/update.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "base/assert.hpp"

namespace grainstep::dem::lammps {

using Instance = LAMMPS_NS::LAMMPS;

/// The moments of a step at which a fix may ask for its turn: PRE_FORCE and so on.
namespace turns = LAMMPS_NS::FixConst;

/// A rank's particles; arrays are valid until particles are next sorted or exchanged. `all`: owned ones and, behind
/// them, the ghosts of other ranks' and of images.
struct Particles {
  int owned = 0;
  int all = 0;
  double** position = nullptr;  ///< m
  double** velocity = nullptr;  ///< m/s
  double** spin = nullptr;      ///< 1/s
  double** force = nullptr;     ///< N
  double** torque = nullptr;    ///< N m
  double* radius = nullptr;     ///< m
  double* mass = nullptr;       ///< kg
  LAMMPS_NS::tagint* identity = nullptr;

  /// The first row of an array, behind which the others lie in one block; nullptr without particles.
  [[nodiscard]] double* block(double** rows) const { return all > 0 ? rows[0] : nullptr; }
};

[[nodiscard]] inline Particles particles_of(LAMMPS_NS::Atom& atom) {
  return {.owned = atom.nlocal,
          .all = atom.nlocal + atom.nghost,
          .position = atom.x,
          .velocity = atom.v,
          .spin = atom.omega,
          .force = atom.f,
          .torque = atom.torque,
          .radius = atom.radius,
          .mass = atom.rmass,
          .identity = atom.tag};
}
[[nodiscard]] inline Particles particles_of(Instance& lammps) { return particles_of(*lammps.atom); }

/// Makes a style of ours known to this instance, under its style_name. Its constructor takes what LAMMPS gives.
template <class Style>
void register_fix(Instance& lammps) {
  (*lammps.modify->fix_map)[Style::style_name] = [](Instance* to, int count, char** words) -> LAMMPS_NS::Fix* {
    return new Style(to, count, words);  // owned by LAMMPS's list of fixes
  };
}
template <class Style>
void register_pair(Instance& lammps) {
  (*lammps.force->pair_map)[Style::style_name] = [](Instance* to) -> LAMMPS_NS::Pair* {
    return new Style(to);  // owned by LAMMPS
  };
}

/// The fix of that id, which is of this style.
template <class Style>
[[nodiscard]] Style& find_fix(LAMMPS_NS::Modify& modify, const char* id) {
  const int index = modify.find_fix(id);
  GS_ASSERT(index >= 0, std::string("no fix ") + id);
  auto* fix = dynamic_cast<Style*>(modify.fix[index]);
  GS_ASSERT(fix != nullptr, std::string("another style of fix ") + id);
  return *fix;
}
template <class Style>
[[nodiscard]] Style& find_fix(Instance& lammps, const char* id) {
  return find_fix<Style>(*lammps.modify, id);
}
template <class Style>
[[nodiscard]] Style& find_pair(Instance& lammps) {
  auto* style = dynamic_cast<Style*>(lammps.force->pair);
  GS_ASSERT(style != nullptr, "another pair style");
  return *style;
}

/// What a script has chosen.
struct Facts {
  double step = 0.0;  ///< s, where the units are SI
  double skin = 0.0;  ///< m, likewise
  int dimension = 3;
  std::string units;
  std::string pair_style;
};
[[nodiscard]] inline Facts facts_of(Instance& lammps) {
  const char* pair = lammps.force->pair_style;
  return {.step = lammps.update->dt,
          .skin = lammps.neighbor->skin,
          .dimension = lammps.domain->dimension,
          .units = lammps.update->unit_style,
          .pair_style = pair == nullptr ? "" : pair};
}

/// For as long as it lives, the command `run` throws Reached, through LAMMPS's reading of the script.
class UntilRun {
 public:
  struct Reached {};

  explicit UntilRun(Instance& lammps) : commands_(*lammps.input->command_map), before_(commands_["run"]) {
    commands_["run"] = [](Instance*) -> LAMMPS_NS::Command* { throw Reached{}; };
  }
  ~UntilRun() { commands_["run"] = before_; }
  UntilRun(const UntilRun&) = delete;
  UntilRun& operator=(const UntilRun&) = delete;

 private:
  LAMMPS_NS::Input::CommandCreatorMap& commands_;
  LAMMPS_NS::Input::CommandCreator before_;
};

/// A fix that carries data with every particle: LAMMPS calls its grow_arrays, copy_arrays and exchange functions.
class ParticleFix : public LAMMPS_NS::Fix {
 public:
  ParticleFix(Instance* lammps, int count, char** words) : Fix(lammps, count, words) { create_attribute = 1; }
  ~ParticleFix() override { atom->delete_callback(id, LAMMPS_NS::Atom::GROW); }
  ParticleFix(const ParticleFix&) = delete;
  ParticleFix& operator=(const ParticleFix&) = delete;
  ParticleFix(ParticleFix&&) = delete;
  ParticleFix& operator=(ParticleFix&&) = delete;

 protected:
  /// To be called by a constructor that has made its own arrays this long.
  [[nodiscard]] int capacity() const { return atom->nmax; }
  void follow_particles() { atom->add_callback(LAMMPS_NS::Atom::GROW); }

  [[nodiscard]] Particles particles() const { return particles_of(*atom); }
  [[nodiscard]] Instance& instance() const { return *lmp; }
  [[nodiscard]] std::uint64_t step() const { return static_cast<std::uint64_t>(update->ntimestep); }
  /// What ghosts carry goes to their owners, through pack_reverse_comm and unpack_reverse_comm.
  void return_from_ghosts() {
    if (comm->nprocs > 1) comm->reverse_comm_fix_variable(this);
  }
  [[nodiscard]] MPI_Comm communicator() const { return world; }
  [[nodiscard]] int rank() const { return comm->me; }
  [[nodiscard]] double skin() const { return neighbor->skin; }  ///< m
  /// Another time step (s), told to everything that keeps it.
  void set_step(double step) const {
    update->dt = step;
    if (force->pair != nullptr) force->pair->reset_dt();
    for (int i = 0; i < modify->nfix; ++i) modify->fix[i]->reset_dt();
  }
  [[noreturn]] void refuse(const std::string& text) const { error->all(FLERR, text); }
  /// The run ends with this step, as if its time were up.
  void end_run() const { timer->force_timeout(); }
};

/// A pair style for all types alike, with one cutoff.
class UniformPair : public LAMMPS_NS::Pair {
 public:
  explicit UniformPair(Instance* lammps) : Pair(lammps) {
    single_enable = 0;
    restartinfo = 0;
    no_virial_fdotr_compute = 1;
    finitecutflag = 1;
  }
  ~UniformPair() override {
    if (allocated == 0) return;
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
  UniformPair(const UniformPair&) = delete;
  UniformPair& operator=(const UniformPair&) = delete;
  UniformPair(UniformPair&&) = delete;
  UniformPair& operator=(UniformPair&&) = delete;

  void coeff(int /*argument_count*/, char** /*arguments*/) override {
    if (allocated == 0) allocate();
    for (int i = 1; i <= atom->ntypes; ++i) {
      for (int j = i; j <= atom->ntypes; ++j) setflag[i][j] = 1;
    }
  }

 protected:
  [[nodiscard]] Particles particles() const { return particles_of(*atom); }
  [[nodiscard]] int dimension() const { return domain->dimension; }
  /// m, of the list of neighbours beyond the cutoff.
  [[nodiscard]] double skin() const { return neighbor->skin; }
  /// s since the last step; 0 while a run is set up.
  [[nodiscard]] double grown() const { return update->setupflag != 0 ? 0.0 : update->dt; }
  [[nodiscard]] double largest_of_all_ranks(double mine) const {
    double out = 0.0;
    MPI_Allreduce(&mine, &out, 1, MPI_DOUBLE, MPI_MAX, world);
    return out;
  }
  [[noreturn]] void refuse(const std::string& text) const {
    error->all(FLERR, text);  // throws (session.cpp)
  }
  /// Refuses what the contact law of spheres cannot work with.
  void require_spheres_with_spin(const std::string& style) const {
    if (atom->sphere_flag == 0) refuse(style + " needs atom_style sphere");
    if (force->newton_pair == 0) refuse(style + " needs newton on");
    if (comm->ghost_velocity == 0) refuse(style + " needs comm_modify vel yes");
  }
  void request_list() { neighbor->request(this, instance_me); }

  void add_fix(const std::string& command) { modify->add_fix(command); }
  template <class Style>
  [[nodiscard]] Style& fix(const char* fix_id) const {
    return find_fix<Style>(*modify, fix_id);
  }
  void remove_fix(const char* fix_id) {
    if (modify->nfix > 0) modify->delete_fix(fix_id);
  }

  /// visit(i) for every particle of the list, then neighbour(i, j) for each of its neighbours, in LAMMPS's order.
  template <class Visit, class Neighbour>
  void for_each_pair(Visit&& visit, Neighbour&& neighbour) const {
    for (int k = 0; k < list->inum; ++k) {
      const int i = list->ilist[k];
      visit(i);
      const int* neighbours = list->firstneigh[i];
      for (int n = 0; n < list->numneigh[i]; ++n) neighbour(i, neighbours[n] & NEIGHMASK);
    }
  }

 private:
  void allocate() {
    const int types = atom->ntypes + 1;
    memory->create(setflag, types, types, "pair:setflag");
    memory->create(cutsq, types, types, "pair:cutsq");
    for (int i = 0; i < types; ++i) std::fill_n(setflag[i], types, 0);
    allocated = 1;
  }
};

}  // namespace grainstep::dem::lammps
