/// @file The contact law of particles: linear spring and dashpot along the normal, spring and slider tangentially
/// (2.1, 2.2). Used for particles on the structure and on the mirror plane; pairs of particles get the same law from
/// LAMMPS's gran/hooke/history. Why and with which signs: docs/theory/contact.md.
#pragma once

#include <algorithm>
#include <cmath>

#include "surface/vec.hpp"

namespace grainstep::dem {

using surface::Vec3;

struct ContactLaw {
  double normal_stiffness = 0.0;      ///< N/m, Kn
  double tangential_stiffness = 0.0;  ///< N/m, Ks
  double damping_rate = 0.0;          ///< 1/s, gamma_n; times the effective mass it is the dashpot's constant
  double friction = 0.0;              ///< mu
  bool tension_cutoff = false;        ///< no pull: the total normal force is never below zero
};

/// Both parts in N, repulsive positive.
struct NormalForce {
  double spring = 0.0;
  double dashpot = 0.0;
  [[nodiscard]] double total() const { return spring + dashpot; }
};

/// Fn = Kn delta + m_eff gamma_n delta_dot (2.1). `overlap` delta in m, positive; `approach` delta_dot in m/s, positive
/// while the overlap grows. Where a cut-off is asked for it takes the dashpot's share, so that the spring's energy
/// stays.
[[nodiscard]] inline NormalForce normal_force(const ContactLaw& law, double overlap, double approach,
                                              double effective_mass) {
  NormalForce force{law.normal_stiffness * overlap, effective_mass * law.damping_rate * approach};
  if (law.tension_cutoff) force.dashpot = std::max(force.dashpot, -force.spring);
  return force;
}

/// The tangential spring follows the surface: its part along the new normal is dropped and its length kept.
/// A spring that would point along the normal (a fold of 90 degrees) is lost.
[[nodiscard]] inline Vec3 turned_into_tangent_plane(const Vec3& spring, const Vec3& normal) {
  const Vec3 flat = spring - dot(spring, normal) * normal;
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

}  // namespace grainstep::dem
