/// @file Which windows a run has and when its extra output is due, and how a side says that any step will do: one rule
/// for participants and orchestrator.
#pragma once

#include <algorithm>
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

/// The next window after `window` at which a report (&Due::report) or a snapshot is due; one behind the last window if
/// none is. A run may have 10^15 windows, too many to look at each.
[[nodiscard]] inline std::uint64_t next_due(const wire::Start& start, std::uint64_t window, bool Due::*which) {
  const bool report = which == &Due::report;
  const double every = report ? start.report_every() : start.snapshot_every();
  if (window >= start.windows() || (!report && !(every > 0.0))) return start.windows() + 1;
  if (!(every > 0.0) || every > static_cast<double>(start.windows())) return start.windows();
  // Where n/every passes its next integer, but for the round-off of that.
  const double passes = (std::floor(static_cast<double>(window) / every) + 1.0) * every;
  const auto before = static_cast<std::uint64_t>(std::max(0.0, passes - 1.0));
  std::uint64_t next = std::clamp(before, window + 1, start.windows());
  while (next < start.windows() && !(due_at(start, next).*which)) ++next;
  return next;
}

}  // namespace grainstep::participant
