/// @file The engine's one own LAMMPS fix, `grainstep/surface`: hands LAMMPS's callbacks to a StepDriver and keeps the
/// tangential springs with their particles through sorting and migration. Why one fix, and why before the pair forces:
/// docs/decisions/0001-how-lammps-is-driven.md and 0002-contact-history.md.
#pragma once

#include <string_view>
#include <vector>

#include "dem-service/lammps/adapter.hpp"
#include "dem-service/lammps/moment.hpp"
#include "dem-service/slug/step_driver.hpp"

namespace grainstep::dem {

class SurfaceFix : public lammps::ParticleFix {
 public:
  static constexpr const char* style_name = "grainstep/surface";

  SurfaceFix(lammps::Instance* lammps, int argument_count, char** arguments);

  /// Both outlive the run. `own_pair_style`: there are energies of contacts between particles to report.
  void connect(StepDriver& driver, Exchange& exchange, bool own_pair_style);

  /// Goes on where another run was saved, before which `run 0` has prepared LAMMPS: `run N pre no` is next. The driver
  /// has heard nothing until then. std::range_error for bytes that are no state of this model.
  void go_on_from(std::string_view state);
  /// While LAMMPS prepares what another run has begun, nothing is handed on.
  void wait() { waits_ = true; }

  int setmask() override;

  void setup_post_neighbor() override { post_neighbor(); }
  void setup_pre_force(int flags) override { pre_force(flags); }
  void setup(int flags) override;
  void post_neighbor() override;
  void pre_force(int flags) override;
  void post_force(int flags) override;
  void end_of_step() override;

  void grow_arrays(int capacity) override;
  void copy_arrays(int from, int to, int delete_flag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  double memory_usage() override;

 private:
  [[nodiscard]] ParticleArrays arrays();

  /// Between the steps of a run, of one process.
  template <class Archive>
  void serialize(Archive& archive, lammps::Moment& moment);
  [[nodiscard]] std::string state();

  template <typename Work>
  void guarded(Work&& work);

  StepDriver* driver_ = nullptr;
  Exchange* exchange_ = nullptr;
  bool own_pair_style_ = true;
  bool waits_ = false;
  std::uint64_t first_step_ = 0;  ///< LAMMPS's count at the start; a script may have set one of its own
  std::vector<surface::Vec3> springs_;
};

}  // namespace grainstep::dem
