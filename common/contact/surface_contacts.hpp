/// @file Contact of particles with the moving surface: who is near, forces, reactions, ledger. The nodes of a block are
/// particles as well, discs that do not turn.
///
/// A surface of revolution is touched in the half plane through the axis and the particle's centre. Its nodes are
/// rings: they get the force's components in that plane, `whole` times; what points along the circumference is dropped.
///
/// Order of calls: rebuild() whenever particles were reordered or either side has moved by its share of the margin;
/// then per step begin_interval(), evaluate(), apply(), and end_interval() once velocities stand at t(n).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contact/contact_law.hpp"
#include "contact/footing.hpp"
#include "contact/interface_ledger.hpp"
#include "contact/meridian.hpp"
#include "contact/moving_surface.hpp"
#include "contact/particle_arrays.hpp"
#include "surface/segment_grid.hpp"

namespace grainstep::contact {

struct SurfaceContactSettings {
  ContactLaw law;
  Shape shape = Shape::extruded;
  double whole = 1.0;  ///< reactions are multiplied by it: full circle over slice
  bool lever_is_radius = false;
  double free_mass = 0.0;         ///< kg, of a free rigid body behind the surface, as a particle meets it; 0: held
  bool chord = false;             ///< contacts act over the chord that the overlap cuts, else at the closest point
  double largest_radius = 0.0;    ///< m
  double particle_margin = 0.0;   ///< m a particle may move between two rebuilds
  double surface_margin = 0.0;    ///< m a node may move between two rebuilds
  const char* name = "particle";  ///< of what touches, in messages
  const char* remedy = "take shorter steps (steps.impactor) or raise normal_stiffness";  ///< against passing through
};

class SurfaceContacts {
 public:
  explicit SurfaceContacts(const SurfaceContactSettings& settings);

  void rebuild(const ParticleArrays& particles, MovingSurface& surface);

  [[nodiscard]] bool surface_left_margin(const MovingSurface& surface) const {
    return surface.wandered() > settings_.surface_margin;
  }

  /// First half of the interval that begins at the last evaluation, with the velocity that the surface has in it.
  void begin_interval(const MovingSurface& surface, double dt);

  /// Finds the forces and adds `weight` times the reactions to `nodal` (N s with weight in s).
  /// `dt` is the time (s) in which tangential springs have grown since the last evaluation; 0 at the start.
  /// Returns what went wrong, if anything: a particle that passed through the surface.
  [[nodiscard]] std::optional<std::string> evaluate(const ParticleArrays& particles, const MovingSurface& surface,
                                                    double dt, double weight, std::vector<surface::Vec2>& nodal);

  /// Adds the forces and torques of the last evaluation to the particles. These must stand in the same order.
  void apply(const ParticleArrays& particles) const;

  /// Second half of the interval that ends at this evaluation; velocities at t(n).
  void end_interval(const ParticleArrays& particles, const MovingSurface& surface, double dt);

  /// Those that touched at the last evaluation.
  template <typename Use>
  void each_touching(Use&& use) const {
    for (const Contact& contact : contacts_) use(contact.particle);
  }

  [[nodiscard]] const InterfaceLedger& ledger() const { return ledger_; }
  [[nodiscard]] std::size_t count() const { return contacts_.size(); }
  [[nodiscard]] double stored_normal() const { return stored_normal_; }          ///< J, at the last evaluation
  [[nodiscard]] double stored_tangential() const { return stored_tangential_; }  ///< J
  [[nodiscard]] const ParticleSide& last() const { return particle_side_; }
  /// Largest overlap over the diameter since the last call.
  [[nodiscard]] double take_largest_overlap() { return std::exchange(largest_overlap_, 0.0); }

  /// What a step leaves for the next one. Springs belong to the particles.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("candidates", candidates_);
    archive("segments near them", near_);
    archive("contacts", contacts_);
    archive("feet", footing_);
    archive("ledger", ledger_);
    archive("particles' side", particle_side_);
    archive("stored in normal springs", stored_normal_);
    archive("stored in tangential springs", stored_tangential_);
    archive("largest overlap", largest_overlap_);
  }

 private:
  struct Candidate {
    int particle;
    std::uint32_t first, last;  ///< range in near_
    double clear = 0.0;         ///< m that particle and surface must come nearer before they can touch
  };
  struct Contact {
    int particle;
    Foot foot;
    Meridian plane;
    surface::Vec3 dashpot, tangential, total, torque;  ///< on the particle
  };

  void touch(const ParticleArrays& particles, const MovingSurface& surface, int i, const Foot& foot, double dt);
  [[nodiscard]] SurfaceSide surface_side(const MovingSurface& surface) const;

  SurfaceContactSettings settings_;
  surface::SegmentGrid grid_;
  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> near_;
  std::vector<Contact> contacts_;
  Footing footing_;
  InterfaceLedger ledger_;
  ParticleSide particle_side_;
  double stored_normal_ = 0.0;
  double stored_tangential_ = 0.0;
  double largest_overlap_ = 0.0;
};

}  // namespace grainstep::contact
