/// @file The contact law of particles: linear spring and dashpot along the normal, spring and slider tangentially
/// (2.1, 2.2). Used for particles on the structure and on the mirror plane, and without dashpot for the nodes of a foam
/// projectile; for pairs of particles it is in dem-service/pair/law.hpp. Why and with which signs:
/// docs/theory/contact.md.
///
/// Operations come in the order in which LAMMPS's granular styles do them: where the same particle meets the same flat
/// wall, every bit of the force is the same. Regrouping a product is allowed, but shows in DemWallGran.
#pragma once

#include <cmath>
#include <memory>

#include "contact/damping_table.hpp"
#include "surface/vec.hpp"

namespace grainstep::contact {

using surface::Vec3;

struct ContactLaw {
  double normal_stiffness = 0.0;      ///< N/m, Kn
  double tangential_stiffness = 0.0;  ///< N/m, Ks
  double damping_rate = 0.0;          ///< 1/s, gamma_n; times the effective mass it is the dashpot's constant
  double friction = 0.0;              ///< mu
  bool tension_cutoff = false;        ///< no pull: the total normal force is never below zero
  std::shared_ptr<const DampingTable> damping_table =
      nullptr;  ///< instead of damping_rate where contacts differ in mass

  [[nodiscard]] double damping(double effective_mass) const {
    return damping_table ? contact::damping_rate(*damping_table, effective_mass) : damping_rate;
  }
};

/// kg, of a body of mass `mass` that meets a free one of `other` head-on; `other` 0: one that is held.
[[nodiscard]] inline double reduced_mass(double mass, double other) {
  return other > 0.0 ? mass * other / (mass + other) : mass;
}

/// The branch vector r n, from the touched point to the particle's centre or from one centre to the other. The law is
/// evaluated with it instead of the unit normal n.
struct Branch {
  Vec3 vector;               ///< m
  double length = 0.0;       ///< m, r; negative for a centre inside the structure
  double per_length = 0.0;   ///< 1/m
  double per_squared = 0.0;  ///< 1/m^2
};

/// `normal` a unit vector; `radius` the particle's, m. A branch without length has no direction to compute with: a
/// centre that lies on the surface itself is taken to lie a billionth of its radius outside.
[[nodiscard]] inline Branch branch_along(const Vec3& normal, double length, double radius) {
  const double shortest = 1e-9 * radius;
  const double r = std::abs(length) < shortest ? shortest : length;
  return {r * normal, r, 1.0 / r, 1.0 / (r * r)};
}

/// The part of `a` along the branch.
[[nodiscard]] inline Vec3 along(const Branch& branch, const Vec3& a) {
  return branch.vector * dot(a, branch.vector) * branch.per_squared;
}

/// Both parts in N per m of the branch vector, by which they are to be multiplied. Repulsive positive.
struct NormalForce {
  double spring = 0.0;
  double dashpot = 0.0;
  [[nodiscard]] double total() const { return spring + dashpot; }
};

/// Fn = Kn delta + m_eff gamma_n delta_dot (2.1), over r. `overlap` delta in m, positive; `relative` the velocity
/// against the partner in m/s. `gain`: -delta_dot over relative.n, 1 where the overlap is measured along n; the force
/// along n is what does the spring's work, so it is multiplied as well. Where a cut-off is asked for it takes the
/// dashpot's share, so that the spring's energy stays.
[[nodiscard]] inline NormalForce normal_force(const ContactLaw& law, const Branch& branch, double overlap,
                                              const Vec3& relative, double effective_mass, double gain = 1.0) {
  const double damping =
      effective_mass * law.damping(effective_mass) * dot(relative, branch.vector) * branch.per_squared;
  NormalForce force{law.normal_stiffness * overlap * branch.per_length * gain, -damping * gain * gain};
  // Inside the structure both parts are divided by a negative length.
  if (law.tension_cutoff && force.total() * branch.length < 0.0) force.dashpot = -force.spring;
  return force;
}

/// Velocity (m/s) of the particle's skin on the partner, in the tangent plane: `lever` (m) from the centre to it.
[[nodiscard]] inline Vec3 slip_rate(const Branch& branch, const Vec3& relative, double lever, const Vec3& spin) {
  const Vec3 rolling = lever * spin * branch.per_length;
  return relative - along(branch, relative) - cross(rolling, branch.vector);
}

/// The tangential spring follows the surface: its part along the new normal is dropped and its length kept.
/// A spring that would point along the normal (a fold of 90 degrees) is lost. One that is off the tangent plane by no
/// more than `negligible` (m) is left as it is: where nothing turns, turning would only add round-off.
[[nodiscard]] inline Vec3 turned_into_tangent_plane(const Vec3& spring, const Vec3& normal, double negligible) {
  const double off = dot(spring, normal);
  if (std::abs(off) <= negligible) return spring;
  const Vec3 flat = spring - off * normal;
  const double flat_length = norm(flat);
  if (!(flat_length > 0.0)) return {};
  return flat * (norm(spring) / flat_length);
}

/// Ft = -Ks s, |Ft| <= mu |Fn| (2.2), in N. `spring` s in m; truncated to the Coulomb limit while sliding.
[[nodiscard]] inline Vec3 tangential_force(const ContactLaw& law, double normal_total, Vec3& spring) {
  const Vec3 trial = spring * -law.tangential_stiffness;
  const double size = norm(trial);
  const double limit = law.friction * std::abs(normal_total);
  if (size <= limit) return trial;
  spring *= limit / size;
  return trial * (limit / size);
}

}  // namespace grainstep::contact
