/// @file Everything that follows from a slug's scene keys: masses, laws, time steps. No LAMMPS, no packing.
#pragma once

#include <cstdint>
#include <numbers>

#include "contact/contact_law.hpp"
#include "dem-service/law/damping.hpp"
#include "grainstep/wire.pb.h"
#include "scene/sizes.hpp"

namespace grainstep::dem {

using contact::ContactLaw;

/// Two-dimensional cylinders of depth b, or spheres in a slice of a cylindrical slug; SI.
struct SlugModel {
  double half_width = 0.0;
  double height = 0.0;
  double speed = 0.0;
  double relative_density = 0.0;
  std::uint64_t seed = 0;
  bool mirror = false;
  double slice = 0.0;       ///< rad, phi: spheres between rigid planes at theta = 0 and phi; 0: discs in the plane
  double angle = 0.0;       ///< rad, of slug and velocity from the normal
  double offset = 0.0;      ///< m, x1 of the leading face's middle
  double stand_off = 0.0;   ///< m, gap at the start
  double tail_speed = 0.0;  ///< m/s; linear to it from `speed` at the head
  bool confined = false;    ///< by walls at |x1| = half_width

  double diameter = 0.0;  ///< m, mean as the scene counts it
  scene::Sizes sizes;     ///< over `diameter`
  double density = 0.0;   ///< kg/m^2, rho_s b of discs; kg/m^3, rho_s of spheres
  double mass = 0.0;      ///< kg, mean of one particle
  std::uint64_t particles = 0;
  bool fixed_number = true;  ///< none may be lost, and none comes
  double heaviest = 0.0;     ///< kg, of particles whose mass does not follow from their size; 0: it does

  ContactLaw pair_law;           ///< damping is left open: it depends on the step
  ContactLaw surface_law;        ///< likewise
  Collision pair;                ///< two of the smallest particles, m_eff = m/2
  Collision on_surface;          ///< one of the smallest particles on the structure, m_eff = m
  bool lever_is_radius = false;  ///< else the distance from the centre to the touched point
  double free_mass = 0.0;        ///< kg, of a free rigid target as one particle meets it; 0: it deforms or is held
  bool chord = false;            ///< contacts act on the surface over the chord that they cut

  double contact_time = 0.0;    ///< t_e of a pair of the smallest, continuum (2.4)
  double stable_step = 0.0;     ///< see largest_stable_step()
  double preferred_step = 0.0;  ///< t_e/10, or the stable step where that is smaller

  [[nodiscard]] bool spheres() const { return slice > 0.0; }
  [[nodiscard]] double smallest() const { return sizes.smallest() * diameter; }  ///< m, diameter
  [[nodiscard]] double largest() const { return sizes.largest() * diameter; }    ///< m, diameter
  /// kg, of a particle of this diameter: rho_s b pi D^2/4 or rho_s pi D^3/6.
  [[nodiscard]] double mass_of(double of_diameter) const;
  [[nodiscard]] double lightest_mass() const;  ///< kg
  [[nodiscard]] double heaviest_mass() const;  ///< kg
  /// By what sizes are scaled for the slug's exact mass, because the number of particles is whole; 1 if all are equal.
  [[nodiscard]] double scale_of_sizes() const;
  /// What is modelled of the whole: sums over a slice's particles times this are those of the full circle.
  [[nodiscard]] double whole() const { return spheres() ? 2.0 * std::numbers::pi / slice : 1.0; }
  /// kg, of all particles of what is modelled.
  [[nodiscard]] double mass_of_all() const { return whole() * mass * static_cast<double>(particles); }
  /// Rotational inertia over m R^2.
  [[nodiscard]] double gyration() const { return spheres() ? 0.4 : 0.5; }
};

/// Throws InputError for what cannot be computed, e.g. a solid fraction above what random packing reaches.
[[nodiscard]] SlugModel make_slug_model(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth,
                                        bool mirror);

/// The slug in front of this target: a free one of `free_mass` (kg, of what is modelled) rebounds itself, and a surface
/// with elements of `facet` (m, on the mean) takes forces at points or over chords, as the scene says.
void meet(SlugModel& model, const scene::SurfaceContact& contact, double free_mass, double facet);

/// The slug of a Setup, in front of the surface that it brings. Throws InputError.
[[nodiscard]] SlugModel slug_model_of(const wire::Setup& setup);

/// Elements narrower than the largest particle over this are too fine for contact at a point, m/m:
/// docs/decisions/0015-contact-over-a-chord.md.
inline constexpr double widest_point_contact = 3.0;

/// The pair law and the surface law with their damping calibrated for the step dt (s): one rate for equal particles,
/// else a table over the effective mass.
[[nodiscard]] ContactLaw calibrated_pair_law(const SlugModel& model, double dt);
[[nodiscard]] ContactLaw calibrated_surface_law(const SlugModel& model, double dt);

/// What the neighbours of a particle in the densest packing add up to: a mode's frequency and damping rate obey
/// omega^2 <= (normal Kn + tangential Ks)/m and c <= damping gamma_n.
struct Neighbours {
  double normal = 0.0, tangential = 0.0, damping = 0.0;
};
/// Six at 60 degrees. A contact adds at most 2 Kn/m along its normal and 6 Ks/m along its tangent (rotation included),
/// and they add up to three times that in any direction.
inline constexpr Neighbours neighbours_of_a_disc{6.0, 18.0, 3.0};
/// Twelve: 2 Kn/m along four times the normals, 7 Ks/m (2 + 2/0.4) along eight times the tangents.
inline constexpr Neighbours neighbours_of_a_sphere{8.0, 56.0, 4.0};

/// A bound on the stable step of densely packed particles, of which `pair` are the lightest, s. Explicit central
/// differences with a dashpot that sees the velocity half a step earlier are stable for every mode of frequency omega
/// and damping rate c as long as (omega dt)^2 + 2 c dt < 4. docs/theory/particles.md has the derivation.
[[nodiscard]] double largest_stable_step(const Collision& pair, double tangential_stiffness,
                                         const Neighbours& neighbours = neighbours_of_a_disc);

}  // namespace grainstep::dem
