/// @file Work and impulse of contact forces, integrated so that they close with the particles' own balance.
///
/// Velocity Verlet changes a particle's kinetic energy by exactly the trapezoidal sum of force times velocity at t(n),
/// up to a term that returns to zero with the force. So every step's power counts half for the interval before and half
/// for the one after it, each with the surface's velocity in that interval. docs/theory/contact.md derives it.
#pragma once

#include "surface/vec.hpp"

namespace grainstep::contact {

/// The parts that depend on particles, velocities at t(n). Powers in W.
struct ParticleSide {
  surface::Vec3 force;      ///< N, on the particles
  double power = 0.0;       ///< force times velocity plus torque times spin
  double dashpot = 0.0;     ///< dashpot force times the particles' velocity
  double tangential = 0.0;  ///< tangential force times the particles' velocity at the touched point
  // On a surface of revolution:
  double radial = 0.0;  ///< N, sum of the components along each particle's own radius
  double size = 0.0;    ///< N, sum of the forces' sizes
  double around = 0.0;  ///< N, sum of the sizes of their components along the circumference: rings do not feel them
  double around_power = 0.0;  ///< W, these components times the particles' velocity
};

/// The same forces times the surface's velocity in one of the two intervals, W.
struct SurfaceSide {
  double power = 0.0;
  double dashpot = 0.0;
  double tangential = 0.0;
};

struct InterfaceLedger {
  surface::Vec3 impulse;           ///< N s, on the particles
  double work_on_particles = 0.0;  ///< J
  double work_on_surface = 0.0;    ///< J
  double damping = 0.0;            ///< J, dissipated by dashpots
  double tangential = 0.0;         ///< J, into tangential springs and sliders
  double radial = 0.0;             ///< N s, integrals over time of what ParticleSide has for surfaces of revolution
  double size = 0.0;               ///< N s
  double around = 0.0;             ///< N s
  double around_work = 0.0;        ///< J, contained in the above

  void add(double interval, const ParticleSide& particles, const SurfaceSide& surface) {
    impulse += particles.force * interval;
    work_on_particles += particles.power * interval;
    work_on_surface -= surface.power * interval;
    damping -= (particles.dashpot - surface.dashpot) * interval;
    tangential -= (particles.tangential - surface.tangential) * interval;
    radial += particles.radial * interval;
    size += particles.size * interval;
    around += particles.around * interval;
    around_work += particles.around_power * interval;
  }
};

}  // namespace grainstep::contact
