/// @file Which windows a run has and when its extra output is due, and how a side says that any step will do: one rule
/// for participants and orchestrator.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "participant/backend.hpp"

namespace grainstep::participant {

/// What a side gives as its stable and preferred step that has no limit of its own.
inline constexpr double no_step_limit = std::numeric_limits<double>::max();

/// True when n/every has passed an integer between window n - 1 and n = `window`: `every` windows apart on the mean,
/// the last of them included. Never for 0.
[[nodiscard]] inline bool falls_due(double every, std::uint64_t window, std::uint64_t windows) {
  if (!(every > 0.0)) return false;
  if (window == 0 || window == windows) return true;
  const auto n = static_cast<double>(window);
  return std::floor(n / every) > std::floor((n - 1.0) / every);
}

/// Reports: at window 0, every `report_every` windows and at the last one. Snapshots likewise, none if `snapshot_every`
/// is 0, and only that of the last window if it is more than there are.
[[nodiscard]] inline Due due_at(const wire::Start& start, std::uint64_t window) {
  const auto windows = start.windows();
  const bool only_last = start.snapshot_every() > static_cast<double>(windows);
  return {.report = falls_due(start.report_every(), window, windows) || window == windows,
          .snapshot = only_last ? window == windows : falls_due(start.snapshot_every(), window, windows)};
}

}  // namespace grainstep::participant
