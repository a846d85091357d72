/// @file The dimensionless groups of what loads a structure (Liu et al. 2013, sections 3 and 4), and the scales that
/// make times and pressures dimensionless. Pure functions, SI.
///
/// A prescribed pressure has the groups that its impulse gives (I_o, and tau from the mean time of its impulse since it
/// began, which is (1/2) H/v0 for a slug); those of particles it has not. What a scene has not is not a number here and
/// `null` in summary.json, never 0.
///
/// A layered structure has one areal mass, the sum over its layers; rho_m and sigma_Y of the groups are those of the
/// layer that yields first from the loaded face (yielding_layer()), which is the paper's reading for both the
/// monolithic beam and the sandwich (face sheets). Where nothing yields there is no sigma_Y: no I_o, tau and t_bar. Of
/// circular plates the radius R takes the place of the half span L.
#pragma once

#include <limits>
#include <optional>

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

/// t in seconds, whichever way it was given; not a number where it is a t_bar and there is no reference time.
[[nodiscard]] double seconds(const Instant& instant, double reference_time);

/// Whose sigma_Y and rho_m are those of the groups: the first layer from the loaded face whose law makes use of a yield
/// strength. A core's is that of its parent solid, the first layer. A rigid target has its layers for mass and groups
/// alone: where none would yield, the first. nullptr: a structure that is elastic all through has no sigma_Y.
[[nodiscard]] const Layer* yielding_layer(const Structure& structure);

/// Where a scene has no such group.
inline constexpr double absent = std::numeric_limits<double>::quiet_NaN();

/// All of them for a scene.
struct Groups {
  double areal_momentum = absent;      ///< I0, kg/(m s) or Pa s: of the particles that are there
  double areal_mass = absent;          ///< m_b, kg/m^2
  double impulse_number = absent;      ///< I_o
  double areal_mass_ratio = absent;    ///< m_bar
  double width_ratio = absent;         ///< a_bar = a/L
  double loading_time_ratio = absent;  ///< tau; infinite for a slug at rest
  double reference_time = absent;      ///< L sqrt(rho_m/sigma_Y), s
  double slug_time = absent;           ///< H/v0, s: t_hat = 1; infinite for a slug at rest
  double arrival = 0;  ///< s: first contact with a structure at rest; stand_off/(v0 cos(angle)), or of a faster tail
  double slug_pressure = absent;  ///< rho_bar rho_s v0^2, Pa: what contact pressure is measured in
  double loaded_width = absent;   ///< m, along x1, of what is modelled: 2a of (4.4), or a of a half model
  double loaded_area = absent;    ///< m^2, of what is modelled: the width times b, or the disc or ring of it
  double end = 0;                 ///< end of the run, s; not a number: a t_bar without a reference time
};

/// Whether something else than the scene says what this is; the scene's slug, or span and layers, then only describe
/// it.
[[nodiscard]] bool is_described_elsewhere(const Impactor& impactor);
[[nodiscard]] bool is_described_elsewhere(const Structure& structure);

/// Whether the scene's impactor is described by its slug.
[[nodiscard]] bool has_slug(const Scene& scene);

/// The undeformed loaded face of what is modelled, m.
struct Span {
  double from = 0.0, to = 0.0;
  [[nodiscard]] double length() const { return to - from; }
  [[nodiscard]] double middle() const { return 0.5 * (from + to); }
};
[[nodiscard]] Span loaded_face(const Structure& structure);

/// The part of `whole` that lies in `range`; of no length where they do not meet.
[[nodiscard]] Span common_part(const Span& whole, const Range& range);

/// Of a part of the undeformed face, m^2: length times depth, or the ring between its ends.
[[nodiscard]] double area(const Scene& scene, const Span& part);

/// Whether particles meet a mirror plane at x1 = 0: a half model in plane strain. (A solid of revolution has none.)
[[nodiscard]] bool has_mirror(const Scene& scene);

/// @param slug_mass kg, of the particles that were made, of what is modelled: their number is whole, so that it is not
/// quite rho_bar rho_s times the slug's volume, and far from it where they are few. rho_bar rho_s of the groups is that
/// mass over that volume. Absent: as the scene has it.
/// @pre a checked scene (load_scene): lengths and densities are positive.
[[nodiscard]] Groups groups(const Scene& scene, std::optional<double> slug_mass = std::nullopt);

}  // namespace grainstep::scene
