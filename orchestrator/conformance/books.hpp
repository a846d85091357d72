/// @file The sums that a participant's reports must show, whatever it computes (docs/theory/step.md).
#pragma once

#include "orchestrator/conformance/played.hpp"

namespace grainstep::conformance {

/// Tolerances, relative to the largest of what is added up: round-off of sums, and what an integration in steps may
/// make or lose (the default guard of a scene).
inline constexpr double round_off = 1e-9;
inline constexpr double of_integration = 0.03;

/// Breach unless interface_impulse is what was handed over up to t(n), times `sign`. `exact`: one step per window, so
/// that it is all before window n and half of window n's; else somewhere between nothing and all of window n's.
void require_interface_impulse(const Played& run, double sign, bool exact);

/// Breach unless linear = start + interface_impulse + support_impulse.
void require_momentum(const Subject& subject, const Played& run);

/// Breach unless energy - interface_work stays what it was.
void require_energy(const Subject& subject, const Played& run);

/// NotOffered for a participant that keeps no books of its own.
void require_full_books(const Subject& subject);

[[nodiscard]] Vector vector_of(const google::protobuf::RepeatedField<double>& values);
[[nodiscard]] double length(const Vector& value);

}  // namespace grainstep::conformance
