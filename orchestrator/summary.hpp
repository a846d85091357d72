/// @file summary.json: a page of numbers for people and scripts (docs/user/results.md says what each means).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "grainstep/wire.pb.h"
#include "orchestrator/recorder.hpp"

namespace grainstep::orchestrator {

struct SummaryInput {
  std::string status;  ///< done, failed, interrupted
  std::string reason;
  const scene::Scene& scene;
  const scene::Groups& groups;
  std::optional<StepPlan> plan;  ///< nullopt: the run did not come that far
  Findings findings;
  wire::Ready impactor;
  wire::Ready structure;
  wire::Timing impactor_timing;
  wire::Timing structure_timing;
  double wall_seconds = 0.0;
  double orchestrator_seconds = 0.0;  ///< processor time of the orchestrator itself
};

/// Numbers that the run did not reach are null.
[[nodiscard]] nlohmann::ordered_json summary(const SummaryInput& input);

/// A few lines for people.
[[nodiscard]] std::string digest(const nlohmann::ordered_json& summary);

}  // namespace grainstep::orchestrator
