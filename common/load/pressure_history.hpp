/// @file A prescribed pressure over time, and its integrals in closed form. Pure, SI; t = 0 is the start of the run.
#pragma once

#include "grainstep/scene.pb.h"

namespace grainstep::load {

/// Throws InputError where a pressure has no history, or a table's times and pressures do not belong together. A loader
/// has seen to that; what comes over the wire has met none.
void require_history(const scene::Pressure& pressure);

/// @pre require_history(), here and below.
/// Integral of the pressure from one time to a later one, Pa s. Exact but for round-off, whatever the interval: what
/// is handed over in steps adds up to the history's own impulse.
[[nodiscard]] double impulse(const scene::Pressure& pressure, double from, double to);

/// The pressure at a time, Pa; at a jump, its value after it.
[[nodiscard]] double pressure_at(const scene::Pressure& pressure, double time);

/// What a history amounts to.
struct Moments {
  double impulse = 0.0;    ///< I0, integral of p, Pa s; infinite where it never ends
  double mean_time = 0.0;  ///< integral of t p over I0, s; not finite where I0 is zero or infinite
  double onset = 0.0;      ///< first instant at which the pressure is not zero, s; not a number where it always is
  double end = 0.0;        ///< from then on it is zero again, s; infinite where it never is
};
[[nodiscard]] Moments moments(const scene::Pressure& pressure);

}  // namespace grainstep::load
