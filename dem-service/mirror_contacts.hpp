/// @file The mirror plane x1 = 0 of a half model: a particle that reaches it touches its own image. Overlap 2(R - x1),
/// effective mass m/2, no tangential force. The pair's energy is shared with the image: half of it is counted here.
#pragma once

#include <utility>
#include <vector>

#include "dem-service/contact_law.hpp"
#include "dem-service/interface_ledger.hpp"
#include "dem-service/particle_arrays.hpp"

namespace grainstep::dem {

class MirrorContacts {
 public:
  /// `margin`: m a particle may move between two rebuilds.
  MirrorContacts(const ContactLaw& pair_law, double margin) : law_(pair_law), margin_(margin) {}

  void rebuild(const ParticleArrays& particles);
  void begin_interval(double dt) { ledger_.add(dt / 2.0, particle_side_, {}); }
  void evaluate(const ParticleArrays& particles);
  /// Adds the forces of the last evaluation to the particles. These must stand in the same order.
  void apply(const ParticleArrays& particles) const;
  void end_interval(const ParticleArrays& particles, double dt);

  /// Its work is zero in sum: what the springs store and the dashpots take is the particles' own.
  [[nodiscard]] const InterfaceLedger& ledger() const { return ledger_; }
  [[nodiscard]] double stored() const { return stored_; }  ///< J, at the last evaluation
  [[nodiscard]] double take_largest_overlap() { return std::exchange(largest_overlap_, 0.0); }  ///< over the diameter

 private:
  struct Contact {
    int particle;
    double total, dashpot;  ///< N, along x1
  };
  ContactLaw law_;
  double margin_;
  std::vector<int> candidates_;
  std::vector<Contact> contacts_;
  InterfaceLedger ledger_;
  ParticleSide particle_side_;
  double stored_ = 0.0;
  double largest_overlap_ = 0.0;
};

}  // namespace grainstep::dem
