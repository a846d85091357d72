#include "participant/check_start.hpp"

#include <cmath>

#include "base/number_text.hpp"

namespace grainstep::participant {
namespace {

/// As many as the orchestrator ever asks for (orchestrator/session/step_plan.cpp): beyond it, no window would end.
constexpr std::uint32_t most_steps_per_window = 1000000000;

bool is_interval(double windows) { return std::isfinite(windows) && windows >= 0.0; }

}  // namespace

std::optional<std::string> start_problem(const wire::Start& start) {
  if (start.first_window() > start.windows()) {
    return "Start begins at window " + std::to_string(start.first_window()) + " of a run of " +
           std::to_string(start.windows());
  }
  if (!(start.window() > 0.0) || !std::isfinite(start.window())) {
    return "Start.window is " + rounded_text(start.window()) + " s; it must be above 0";
  }
  for (const auto& [name, steps] :
       {std::pair("impactor_steps", start.impactor_steps()), std::pair("structure_steps", start.structure_steps())}) {
    if (steps >= 1 && steps <= most_steps_per_window) continue;
    return "Start." + std::string(name) + " is " + std::to_string(steps) + "; a window has 1 to " +
           std::to_string(most_steps_per_window) + " steps";
  }
  for (const auto& [name, every] :
       {std::pair("report_every", start.report_every()), std::pair("snapshot_every", start.snapshot_every())}) {
    if (is_interval(every)) continue;
    return "Start." + std::string(name) + " is " + rounded_text(every) + " windows; it must be 0 or above";
  }
  return std::nullopt;
}

}  // namespace grainstep::participant
