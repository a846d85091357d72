/// @file What a sandwich core's keys mean together (Liu et al. 2013, section 3.2). Pure functions, SI. The parent solid
/// of a core is the material of the loaded face, the scene's first layer.
#pragma once

#include "grainstep/scene.pb.h"

namespace grainstep::scene {

/// rho_c/rho_m.
[[nodiscard]] double core_relative_density(const Structure& structure, const Layer& core);

/// Nominal densification strain eps_D = 1 - 1.5 rho_c/rho_m (3.9).
[[nodiscard]] double densification_strain(double relative_density);

/// Viscosity, Pa s, that makes a shock of speed v0 as wide as `width`: l = eta eps_D/(rho_c v0)            (3.10)
[[nodiscard]] double shock_viscosity(double width, double density, double speed, double densification_strain);

/// Gives every core layer that has no viscosity the one of (3.10), with v0 the slug's speed. Those that cannot have one
/// (a scene without a slug) stay without.
void resolve_cores(Scene& scene);

}  // namespace grainstep::scene
