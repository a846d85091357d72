/// @file From the coefficient of restitution to the dashpot: the continuous law (2.3, 2.4), and the constant that
/// returns the same restitution once the collision is computed in steps.
#pragma once

#include "contact/damping_table.hpp"

namespace grainstep::dem {

/// A head-on collision of two bodies, seen as one body of the effective mass on a spring.
struct Collision {
  double stiffness = 0.0;       ///< N/m, Kn
  double effective_mass = 0.0;  ///< kg: m/2 for two equal particles, m for a particle on a heavy structure
  double restitution = 0.0;     ///< e, 0 < e <= 1
  bool tension_cutoff = false;  ///< the total force is never below zero
};

/// gamma_n = sqrt(4 Kn/(m_eff (1 + (pi/ln e)^2))) in 1/s: (2.3) with m_eff = m/2. 0 for e = 1.
[[nodiscard]] double continuum_damping(const Collision& collision);

/// t_e = -2 ln(e)/gamma_n in s (2.4); pi sqrt(m_eff/Kn) for e = 1.
[[nodiscard]] double contact_time(const Collision& collision);

/// Restitution of the discrete scheme with damping rate `gamma` (1/s) and step `dt` (s): velocity Verlet whose dashpot
/// sees the velocity half a step earlier, as LAMMPS computes it. The first overlap can be anything between nothing and
/// one step's way: the mean over this phase of entry.
[[nodiscard]] double discrete_restitution(const Collision& collision, double gamma, double dt);

/// The damping rate (1/s) for which discrete_restitution() is `collision.restitution`; tends to continuum_damping() as
/// dt goes to 0; to a part of `tolerance`. For contacts of more than 256 steps
/// it is extrapolated. Throws InputError where the step is too coarse for such a rate to exist.
[[nodiscard]] double calibrated_damping(const Collision& collision, double dt, double tolerance = 1e-13);

/// calibrated_damping() of all effective masses from `lightest.effective_mass` to `heaviest` (kg), for the step dt (s).
[[nodiscard]] contact::DampingTable damping_table(const Collision& lightest, double heaviest, double dt);

}  // namespace grainstep::dem
