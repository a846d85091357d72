/// @file Frictionless rigid planes that no structure carries: the mirror plane of a half model, the walls that confine
/// a slug to its strip, and those between which a slice of a slug moves. A particle at a mirror touches its own image:
/// overlap 2(R - distance), effective mass m/2; the pair's energy is shared with the image, half of it is counted here.
/// At a wall it moves alone: overlap R - distance, m_eff = m.
#pragma once

#include <utility>
#include <vector>

#include "contact/contact_law.hpp"
#include "contact/interface_ledger.hpp"
#include "contact/particle_arrays.hpp"

namespace grainstep::dem {

using contact::ContactLaw;
using contact::InterfaceLedger;
using contact::ParticleArrays;
using contact::ParticleSide;
using surface::Vec3;

struct Plane {
  enum class Kind { mirror, wall };
  Kind kind = Kind::wall;
  Vec3 inward{{1.0, 0.0, 0.0}};  ///< unit normal, towards the particles
  double position = 0.0;         ///< m, of the plane along it
};

class PlaneContacts {
 public:
  /// `margin`: m a particle may move between two rebuilds. The law is that of a pair for a mirror, of a particle that
  /// moves alone for a wall; its tangential part is not used.
  PlaneContacts(const Plane& plane, const ContactLaw& law, double margin) : plane_(plane), law_(law), margin_(margin) {}

  void rebuild(const ParticleArrays& particles);
  void begin_interval(double dt) { ledger_.add(dt / 2.0, particle_side_, {}); }
  void evaluate(const ParticleArrays& particles);
  /// Adds the forces of the last evaluation to the particles. These must stand in the same order.
  void apply(const ParticleArrays& particles) const;
  void end_interval(const ParticleArrays& particles, double dt);

  /// Those that touched at the last evaluation.
  template <typename Use>
  void each_touching(Use&& use) const {
    for (const Contact& contact : contacts_) use(contact.particle);
  }

  /// Its work is zero in sum: what the springs store and the dashpots take is the particles' own.
  [[nodiscard]] const InterfaceLedger& ledger() const { return ledger_; }
  [[nodiscard]] double stored() const { return stored_; }  ///< J, at the last evaluation
  [[nodiscard]] double take_largest_overlap() { return std::exchange(largest_overlap_, 0.0); }  ///< over the diameter

  template <class Archive>
  void serialize(Archive& archive) {
    archive("candidates", candidates_);
    archive("contacts", contacts_);
    archive("ledger", ledger_);
    archive("particles' side", particle_side_);
    archive("stored", stored_);
    archive("largest overlap", largest_overlap_);
  }

 private:
  struct Contact {
    int particle;
    Vec3 total, dashpot;  ///< N
  };
  [[nodiscard]] double distance(const ParticleArrays& particles, int i) const {
    return dot(plane_.inward, contact::vector_of(particles.position[i])) - plane_.position;
  }

  Plane plane_;
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
