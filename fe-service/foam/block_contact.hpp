/// @file The nodes of a block on the moving surface: what the particles of a slug do there
/// (contact/surface_contacts.hpp), done by discs of the nodes' mass that do not turn. Nodes of a
/// solid of revolution are rings and meet the rings of the surface, in the half plane of both; sums are those of the
/// full circle. A contact is as stiff as what of the outline is the node's.
///
/// Order of calls per step: begin_interval(), evaluate(), push(), end_interval().
#pragma once

#include "contact/moving_surface.hpp"
#include "contact/surface_contacts.hpp"
#include "fe-service/body.hpp"
#include "fe-service/foam/model.hpp"

namespace grainstep::fe {

class BlockContact {
 public:
  BlockContact(const FoamModel& model, const Body& body);

  /// First half of the interval of `dt` (s) that begins at the last evaluation.
  void begin_interval(const contact::MovingSurface& surface, double dt) { contacts_.begin_interval(surface, dt); }

  /// Forces with the nodes where they stand, velocities of the step that brought them there, which lasted `dt` (s; 0 at
  /// the start). Adds `weight` times the reactions to `nodal`. Throws NumericalError for a node that has passed through
  /// the surface, or one that moves further than its radius in a step of `next` (s).
  void evaluate(const Body& body, contact::MovingSurface& surface, double dt, double next, double weight,
                std::vector<surface::Vec2>& nodal);

  /// Adds weight/mass times the forces to the nodes' velocities.
  void push(Body& body, double weight);

  /// Second half of the interval of `dt` that ends at this evaluation. Velocities at t(n) lie `part` of the way from
  /// those of the evaluation to those of the body.
  void end_interval(const Body& body, const contact::MovingSurface& surface, double dt, double part);

  /// What a step leaves for the next one. Where the nodes are, and how fast, is the body's.
  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed("springs", spring_);
    archive.fixed("remembered", remembered_);
    archive("contacts", contacts_);
    archive("built", built_);
  }

  [[nodiscard]] const contact::SurfaceContacts& contacts() const { return contacts_; }
  [[nodiscard]] double take_largest_overlap() { return contacts_.take_largest_overlap(); }

 private:
  [[nodiscard]] contact::ParticleArrays arrays();
  void look(const Body& body, double next);

  std::vector<std::size_t> nodes_;  ///< corners of the body
  std::vector<surface::Vec3> position_, velocity_, force_, torque_, spring_, remembered_;
  std::vector<double*> position_rows_, velocity_rows_, spin_rows_, force_rows_, torque_rows_;
  std::vector<double> radius_, mass_;
  std::vector<double> area_;  ///< m^2, of the undeformed outline
  std::vector<std::int32_t> identity_;
  surface::Vec3 no_spin_{};
  double reach_;  ///< m, largest radius and margin
  contact::SurfaceContacts contacts_;
  bool built_ = false;
};

}  // namespace grainstep::fe
