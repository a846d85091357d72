/// @file What is left when the load is over: the deflection that the structure swings about. Pure.
#pragma once

#include <optional>
#include <span>

namespace grainstep::orchestrator {

/// What a row knows of it.
struct DeflectionSample {
  double time = 0.0;        ///< s
  double deflection = 0.0;  ///< m
  double load = 0.0;        ///< N s, sum of the sizes of all impulses so far: it never falls
};

struct Oscillation {
  double from = 0.0, to = 0.0;  ///< s
  double mean = 0.0;            ///< m, over time
  double spread = 0.0;          ///< m, half the difference between its largest and its smallest deflection
};

/// The last whole swing after the load. The load is over where less than a thousandth of all impulse is still to come:
/// a blast decays for ever, and single grains come down late. A swing is what lies between two passages of the same
/// direction through the middle of the range, with both quarters of the range at its ends visited in between, so that
/// the ripple of higher modes makes none; a tenth of it is enough where swings die away so fast that there are no
/// others. What the structure does before its first turn (it deflects on, under its own inertia) belongs to no swing.
/// Nothing where the load is still on, no swing was completed, or fewer than eight samples tell of it.
/// @param samples in order of time.
[[nodiscard]] std::optional<Oscillation> last_free_oscillation(std::span<const DeflectionSample> samples);

}  // namespace grainstep::orchestrator
