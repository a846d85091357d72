/// @file Which windows a run has and when its extra output is due, and how a side says that any step will do: one rule
/// for participants and orchestrator.
#pragma once

#include <cstdint>
#include <limits>

#include "participant/backend.hpp"

namespace grainstep::participant {

/// What a side gives as its stable and preferred step that has no limit of its own.
inline constexpr double no_step_limit = std::numeric_limits<double>::max();

/// Reports: every `report_every` windows and after the last one. Snapshots: every `snapshot_every` windows, none if 0.
[[nodiscard]] inline Due due_at(const wire::Start& start, std::uint64_t window) {
  const auto falls = [window](std::uint64_t every) { return every != 0 && window % every == 0; };
  return {.report = falls(start.report_every()) || window == start.windows(),
          .snapshot = falls(start.snapshot_every())};
}

}  // namespace grainstep::participant
