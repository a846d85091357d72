/// @file The fix through which LIGGGHTS's steps are seen: hands its callbacks to a StepDriver, keeps the tangential
/// springs of contacts with the surface beside their particles, and the books of contacts between particles.
#pragma once

#include <liggghts/fix.h>

#include <contact/contact_law.hpp>
#include <dem-service/slug/exchange.hpp>
#include <dem-service/slug/step_driver.hpp>
#include <optional>
#include <vector>

#include "contact_books.hpp"

class SurfaceFix final : public LAMMPS_NS::Fix {
 public:
  static constexpr const char* style_name = "grainstep/surface";

  /// Thrown through LIGGGHTS's loop over the steps once no further one is wanted.
  struct Ended {};

  SurfaceFix(LAMMPS_NS::LAMMPS* liggghts, int argument_count, char** arguments);
  ~SurfaceFix() override;
  SurfaceFix(const SurfaceFix&) = delete;
  SurfaceFix& operator=(const SurfaceFix&) = delete;

  /// Both outlive the run. `law`: of contacts between particles, as LIGGGHTS was given it.
  void connect(grainstep::dem::StepDriver& driver, grainstep::dem::Exchange& exchange,
               const grainstep::contact::ContactLaw& law);

  int setmask() override;
  void setup_pre_force(int flags) override;
  void setup(int flags) override;
  void pre_force(int flags) override;
  void post_force(int flags) override;
  void end_of_step() override;

  void grow_arrays(int capacity) override;
  void copy_arrays(int from, int to, int delete_flag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;

  int n_history_extra() override { return ContactBooks::values; }
  bool history_args(char** names_and_flags) override;

 private:
  [[nodiscard]] grainstep::contact::ParticleArrays arrays();
  [[nodiscard]] std::uint64_t step() const;
  template <typename Work>
  void guarded(Work&& work);

  grainstep::dem::StepDriver* driver_ = nullptr;
  grainstep::dem::Exchange* exchange_ = nullptr;
  std::optional<ContactBooks> books_;
  std::vector<grainstep::surface::Vec3> springs_;
};
