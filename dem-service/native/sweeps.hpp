/// @file The loops over all grains and all pairs that may touch, compiled once per instruction set. Plain data, for it is
/// shared with files compiled for other instruction sets; the results do not depend on which of them runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grainstep::dem::native {

/// Grains [first, last) get their impulse and move on.
struct Motion {
  double* rows = nullptr;    ///< as rows.hpp has them
  double* forces = nullptr;  ///< N; zero afterwards
  float* places = nullptr;   ///< m from `origin`, for the search
  const double* per_mass = nullptr;     ///< 1/kg
  const double* per_inertia = nullptr;  ///< 1/(kg m^2)
  double kick = 0.0;                    ///< s, in which the forces act: dt, or dt/2 in the first step
  double drift = 0.0;                   ///< s, in which grains move: dt
  double frame[3] = {0.0, 0.0, 0.0};    ///< m/s, of the frame in which speeds are judged
  double origin[3] = {0.0, 0.0, 0.0};   ///< m
  std::ptrdiff_t first = 0, last = 0;
};

/// Pairs that may touch, by the numbers of their grains.
struct PairList {
  const std::int32_t* first = nullptr;
  const std::int32_t* second = nullptr;
  std::ptrdiff_t count = 0;
};

/// Ranges of grains in each of which all are candidates.
struct Candidates {
  const float* places = nullptr;
  const float* reach = nullptr;  ///< m, radius and what a grain may move before lists are made anew
  std::ptrdiff_t grain = 0;
  std::ptrdiff_t first = 0, last = 0;
};

struct Sweeps {
  const char* name;
  /// Returns a bound on the speed in the frame of all grains in the range, m/s squared. [dimension - 2]
  double (*move[2])(const Motion& motion);
  /// Writes the numbers of pairs nearer than `reach` (m) to `found`, which has room for all and one more; returns how
  /// many. `radii`: of all grains, read instead of `reach` where it is not null; `slack` is added to both radii.
  std::ptrdiff_t (*touching[2])(const float* places, const PairList& pairs, float reach, const float* radii,
                                float slack, std::int32_t* found);
  /// Writes the numbers of grains within reach of one to `found`, which has room for all and one more.
  std::ptrdiff_t (*near[2])(const Candidates& candidates, std::int32_t* found);
};

/// Copies that this machine can run, the fastest first.
[[nodiscard]] const std::vector<const Sweeps*>& available_sweeps();

}  // namespace grainstep::dem::native
