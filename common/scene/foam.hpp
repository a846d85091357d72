/// @file What a foam projectile's keys mean together (Liu et al. 2013, sections 4.3 and 6.4). Pure functions, SI.
#pragma once

#include "grainstep/scene.pb.h"

namespace grainstep::scene {

/// rho_bar rho_s, kg/m^3.
[[nodiscard]] double foam_density(const Slug& slug);

/// rho_max of (4.13): as given, else 0.9 for discs and 0.74 for spheres, which are those of a solid of revolution.
[[nodiscard]] double densest_packing(const Foam& foam, Symmetry symmetry);

/// eps_D = 1 - rho_bar/rho_max                                                                             (4.13)
[[nodiscard]] double locking_strain(const Impactor& impactor, Symmetry symmetry);

/// Young's modulus of the packed particles, Pa: of discs 3 sqrt(3) Kn/(4 b), of spheres 4 sqrt(2) Kn/(3 D)
/// (4.11), (6.4)
[[nodiscard]] double foam_modulus(const Particle& particle, Symmetry symmetry, double depth);

/// Elastic strain behind the shock on a wall, p/M: pressure rho_bar rho_s v0^2/eps_D over the longitudinal modulus of
/// what has locked.
[[nodiscard]] double strain_behind_shock(const Scene& scene);

}  // namespace grainstep::scene
