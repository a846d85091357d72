/// @file What happens in every step besides LAMMPS's own: contact with the surface and rigid planes, exchange, ledger.
/// No LAMMPS.
///
/// Calls per step, in this order: rebuild() if particles were reordered or left their margin, before_pair_forces(),
/// after_pair_forces(), end_of_step(). Step 0 is the state at the start. Window n ends with step n times
/// impactor_steps.
#pragma once

#include <optional>

#include "dem-service/slug/exchange.hpp"
#include "dem-service/slug/model.hpp"
#include "dem-service/slug/report.hpp"

namespace grainstep::dem {

struct StepSettings {
  double dt = 0.0;      ///< s
  double margin = 0.0;  ///< m a particle may move between two rebuilds
};

class StepDriver {
 public:
  StepDriver(const SlugModel& model, const wire::Start& start, const StepSettings& settings, MovingSurface surface,
             Exchange& exchange);

  void rebuild(const ParticleArrays& particles);

  /// Contact with surface and planes at this step; at a window's end the impulse is on its way before this returns.
  void before_pair_forces(std::uint64_t step, const ParticleArrays& particles);

  /// Adds the forces on particles that touch the surface, a mirror or a wall.
  void after_pair_forces(std::uint64_t step, const ParticleArrays& particles);

  /// Velocities at t(n). `pairs`: of this rank's contacts between particles.
  void end_of_step(std::uint64_t step, const ParticleArrays& particles, const PairEnergy& pairs);

  /// Particles whose velocity end_of_step() looks at in this step: all of them, or those that touch.
  [[nodiscard]] bool looks_at_all(std::uint64_t step) const {
    const participant::Due due = due_after(step);
    return due.report || due.snapshot;
  }
  template <typename Use>
  void each_touching(Use&& use) const {
    contacts_.each_touching(use);
    for (const PlaneContacts& plane : planes_) plane.each_touching(use);
  }

  /// m, x2 of the surface's highest node now.
  [[nodiscard]] double top_of_surface() const;

  /// What a step leaves for the next one, at the end of a window.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("surface", surface_);
    archive("contacts with it", contacts_);
    for (PlaneContacts& plane : planes_) archive("plane", plane);
    archive("largest overlap of pairs", largest_pair_overlap_);
    archive("dissipation", dissipation_);
    archive("nodal impulses", nodal_);
  }

  /// Whether somebody wants the state at the end of this step; asked once, after end_of_step().
  [[nodiscard]] bool state_is_wanted(std::uint64_t step) {
    return !ended_ && step % start_.impactor_steps() == 0 && exchange_.wants_state(step / start_.impactor_steps());
  }

  /// No further step is wanted.
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  [[nodiscard]] bool waits_after_pair_forces(std::uint64_t step) const;
  void touch(std::uint64_t step, const ParticleArrays& particles);
  void next_interval(std::uint64_t step, const ParticleArrays& particles);
  void check_speed(const ParticleArrays& particles);
  void check_surface_speed();
  [[nodiscard]] participant::Due due_after(std::uint64_t step) const;
  void report(std::uint64_t window, std::uint64_t step, const ParticleArrays& particles, const PairEnergy& pairs);

  SlugModel model_;
  wire::Start start_;
  StepSettings settings_;
  MovingSurface surface_;
  Exchange& exchange_;
  SurfaceContacts contacts_;
  std::vector<PlaneContacts> planes_;  ///< mirror and walls
  double largest_pair_overlap_ = 0.0;  ///< over the diameter, since the last report
  DissipationGuard dissipation_;
  std::vector<surface::Vec2> nodal_;
  bool ended_ = false;
};

}  // namespace grainstep::dem
