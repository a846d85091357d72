/// @file The dimensionless groups of a slug that hits a structure (Liu et al. 2013, sections 3 and 4), and the scales
/// that make times and pressures dimensionless. Pure functions, SI.
///
/// A layered structure has one areal mass, the sum over its layers; rho_m and sigma_Y of the groups are those of its
/// first (loaded) layer, which is the paper's reading for both the monolithic beam and the sandwich (face sheets).
#pragma once

#include "grainstep/scene.pb.h"

namespace grainstep::scene {

/// I0 = rho_bar rho_s H v0, kg/(m s): momentum per loaded area. Where head and tail differ in speed, v0 is their mean.
[[nodiscard]] double areal_momentum(double relative_density, double material_density, double height, double speed);

/// m_b = sum of density times thickness, kg/m^2.
[[nodiscard]] double areal_mass(const Structure& structure);

/// I_o = I0 / (m_b sqrt(sigma_Y/rho_m)).
[[nodiscard]] double impulse_number(double areal_momentum, double areal_mass, double yield_strength, double density);

/// m_bar = rho_bar rho_s H / m_b.
[[nodiscard]] double areal_mass_ratio(double relative_density, double material_density, double height,
                                      double areal_mass);

/// L sqrt(rho_m/sigma_Y), s: t_bar = 1.
[[nodiscard]] double reference_time(double half_span, double density, double yield_strength);

/// tau = (1/2) (H/v0) / (L sqrt(rho_m/sigma_Y)) (4.6).
[[nodiscard]] double loading_time_ratio(double slug_time, double reference_time);

/// t in seconds, whichever way it was given.
[[nodiscard]] double seconds(const Instant& instant, double reference_time);

/// All of them for a scene.
struct Groups {
  double areal_momentum = 0;      ///< I0, kg/(m s)
  double areal_mass = 0;          ///< m_b, kg/m^2
  double impulse_number = 0;      ///< I_o
  double areal_mass_ratio = 0;    ///< m_bar
  double width_ratio = 0;         ///< a_bar = a/L
  double loading_time_ratio = 0;  ///< tau; infinite for a slug at rest
  double reference_time = 0;      ///< L sqrt(rho_m/sigma_Y), s
  double slug_time = 0;           ///< H/v0, s: t_hat = 1; infinite for a slug at rest
  double arrival = 0;             ///< stand_off/v0, s: first contact
  double slug_pressure = 0;       ///< rho_bar rho_s v0^2, Pa: what contact pressure is measured in
  double end = 0;                 ///< end of the run, s
};

/// @pre a checked scene (load_scene): it has a layer, and lengths and densities are positive.
[[nodiscard]] Groups groups(const Scene& scene);

}  // namespace grainstep::scene
