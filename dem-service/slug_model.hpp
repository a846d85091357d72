/// @file Everything that follows from a slug's scene keys: masses, laws, time steps. No LAMMPS, no packing.
#pragma once

#include <cstdint>

#include "contact/contact_law.hpp"
#include "dem-service/damping.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::dem {

using contact::ContactLaw;

/// Two-dimensional cylinders of depth b; SI.
struct SlugModel {
  double half_width = 0.0;
  double height = 0.0;
  double speed = 0.0;
  double relative_density = 0.0;
  std::uint64_t seed = 0;
  bool mirror = false;
  double angle = 0.0;       ///< rad, of slug and velocity from the normal
  double offset = 0.0;      ///< m, x1 of the leading face's middle
  double stand_off = 0.0;   ///< m, gap at the start
  double tail_speed = 0.0;  ///< m/s; linear to it from `speed` at the head
  bool confined = false;    ///< by walls at |x1| = half_width

  double diameter = 0.0;
  double mass = 0.0;  ///< of one particle, rho_s b pi D^2/4
  std::uint64_t particles = 0;

  ContactLaw pair_law;           ///< damping_rate is left open: it depends on the step
  ContactLaw surface_law;        ///< likewise
  Collision pair;                ///< two equal particles, m_eff = m/2
  Collision on_surface;          ///< a particle on the structure, m_eff = m
  bool lever_is_radius = false;  ///< else the distance from the centre to the touched point

  double contact_time = 0.0;    ///< t_e of a pair, continuum (2.4)
  double stable_step = 0.0;     ///< see largest_stable_step()
  double preferred_step = 0.0;  ///< t_e/10, or the stable step where that is smaller
};

/// Throws InputError for what cannot be computed, e.g. a solid fraction above what random packing reaches.
[[nodiscard]] SlugModel make_slug_model(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth,
                                        bool mirror);

/// The pair law and the surface law with their damping rates calibrated for the step dt (s).
[[nodiscard]] ContactLaw calibrated_pair_law(const SlugModel& model, double dt);
[[nodiscard]] ContactLaw calibrated_surface_law(const SlugModel& model, double dt);

/// A bound on the stable step of densely packed discs, s. Explicit central differences with a dashpot that sees the
/// velocity half a step earlier are stable for every mode of frequency omega and damping rate c as long as
/// (omega dt)^2 + 2 c dt < 4. A disc with its six neighbours has omega^2 <= 6 Kn/m + 18 Ks/m and c <= 3 gamma_n: each
/// contact adds at most 2 Kn/m along its normal and 6 Ks/m along its tangent (rotation included), and six directions at
/// 60 degrees add up to three times that in any direction. docs/theory/particles.md has the derivation.
[[nodiscard]] double largest_stable_step(const Collision& pair, double tangential_stiffness);

}  // namespace grainstep::dem
