/// @file What makes a computed state unusable, found and located. The kernel's own numbers cannot show NaN
/// (-ffast-math).
#pragma once

#include "fe-service/body.hpp"

namespace grainstep::fe {

/// Where in a run the state stands, for messages.
struct Progress {
  std::uint64_t step = 0;       ///< structure steps taken
  double time = 0.0;            ///< s
  double last_good_time = 0.0;  ///< s, of the last state that passed all checks
  // Of which body, and the keys that change its mesh and its step.
  const char* body = "structure";
  const char* mesh_key = "structure.mesh.refinement";
  const char* step_key = "steps.structure";
};

/// Throws NumericalError naming the worst element if its area over its undeformed area is below `limit`.
void check_quality(const Body& body, double limit, const Progress& progress);

/// Throws NumericalError naming the quad whose stable step over that of the undeformed mesh is below `limit`: plastic
/// flow keeps the area of an element that it draws out into a needle, so that check_quality() does not see it.
void check_slivers(const Body& body, double undeformed_step, double limit, const Progress& progress);

/// Throws NumericalError naming the first node that is not a finite number.
void check_finite(const Body& body, const Progress& progress);

/// Throws NumericalError naming the quad whose stable step is smaller than `step`, which the scene has fixed.
void check_fixed_step(const Body& body, double step, const Progress& progress);

/// Throws NumericalError: the material's local iteration did not converge.
[[noreturn]] void material_failed(const Body& body, const Progress& progress);

/// How many steps of at most `longest` s a window of `window` s takes. Throws NumericalError where no run could take so
/// many.
[[nodiscard]] std::uint32_t steps_needed(double window, double longest, const Progress& progress);

}  // namespace grainstep::fe
