/// @file The loops over all grains and all pairs that may touch, compiled once per instruction set. Plain data, for it
/// is shared with files compiled for other instruction sets; the results do not depend on which of them runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem-service/pair/pair.hpp"

namespace grainstep::dem::native {

/// What is read and written in one go, whatever the instruction set: arrays have room for so many more.
inline constexpr std::size_t lanes_at_once = 8;

/// Grains [first, last) get their impulse and move on.
struct Motion {
  double* rows = nullptr;               ///< as rows.hpp has them
  double* forces = nullptr;             ///< N; zero afterwards
  float* places = nullptr;              ///< m from `origin`, for the search
  const double* per_mass = nullptr;     ///< 1/kg
  const double* per_inertia = nullptr;  ///< 1/(kg m^2)
  std::ptrdiff_t each = 1;              ///< 0: all grains have what the first one has
  double kick = 0.0;                    ///< s, in which the forces act: dt, or dt/2 in the first step
  double drift = 0.0;                   ///< s, in which grains move: dt
  double frame[3] = {0.0, 0.0, 0.0};    ///< m/s, of the frame in which speeds are judged
  double origin[3] = {0.0, 0.0, 0.0};   ///< m
  std::ptrdiff_t first = 0, last = 0;
};

/// Pairs of a list, and how near the two of a pair must be for it to be found.
struct PairSearch {
  const float* places = nullptr;
  const Pair* pairs = nullptr;
  const std::uint32_t* numbers = nullptr;  ///< what is written of each; null: where it stands
  std::ptrdiff_t first = 0, last = 0;      ///< those that are looked at
  float reach = 0.0F;                      ///< m, of two grains
  const float* radii = nullptr;            ///< m, of each grain, read instead of `reach` where it is not null
  float slack = 0.0F;                      ///< m, is added
};

/// Grains [first, last); none where that is no range.
struct Range {
  std::int32_t first, last;
};

/// Ranges of grains in each of which all are candidates.
struct Candidates {
  const float* places = nullptr;
  const float* reach = nullptr;  ///< m, radius and what a grain may move before lists are made anew
  std::ptrdiff_t grain = 0;
  const Range* ranges = nullptr;
  int count = 0;
};

/// What grains [first, last) have moved since `before` was written, in a frame that has moved by `shift` (m).
struct Displacement {
  const float* places = nullptr;
  const float* before = nullptr;
  float shift[3] = {0.0F, 0.0F, 0.0F};
  std::ptrdiff_t first = 0, last = 0;
};

struct Sweeps {
  const char* name;
  /// Returns a bound on the speed in the frame of all grains in the range, m/s squared. [dimension - 2]
  double (*move[2])(const Motion& motion);
  /// Writes the numbers of pairs that are near enough to `found`; returns how many.
  std::ptrdiff_t (*touching[2])(const PairSearch& search, std::uint32_t* found);
  /// The largest, m squared.
  float (*displaced[2])(const Displacement& displacement);
  /// Writes the pairs of one grain with those within its reach to `found`; returns how many.
  std::ptrdiff_t (*near[2])(const Candidates& candidates, Pair* found);
};

/// Copies that this machine can run, the fastest first.
[[nodiscard]] const std::vector<const Sweeps*>& available_sweeps();

}  // namespace grainstep::dem::native
