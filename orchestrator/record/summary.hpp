/// @file summary.json: a page of numbers for people and scripts (docs/user/results.md says what each means).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "grainstep/wire.pb.h"
#include "orchestrator/process/threads.hpp"
#include "orchestrator/record/recorder.hpp"

namespace grainstep::orchestrator {

struct SummaryInput {
  std::string status;  ///< done, failed, interrupted
  std::string reason;
  int exit_code = 0;
  const scene::Scene& scene;
  const scene::Groups& groups;
  std::optional<StepPlan> plan;  ///< nullopt: the run did not come that far
  Findings findings;
  wire::Ready impactor;
  wire::Ready structure;
  wire::Timing impactor_timing;
  wire::Timing structure_timing;
  ThreadShares threads = {};
  std::string path = "hub";  ///< of Forces and Kinematics: hub, shared
  double wall_seconds = 0.0;
  double orchestrator_seconds = 0.0;  ///< processor time of the orchestrator itself
};

/// What a scene's results depend on besides the scene. Raise it with every change after which some scene gives other
/// numbers than before (a law, a scheme, a default of the code's own): studies then compute again what they have
/// (docs/decisions/0010-studies.md). Restructuring, speed and new kinds of scenes leave it alone.
// 2: energy and steps of foams. 3: contact over chords, windows of free targets, scales and impulses of what is there,
// evenly spread rows. 4: the native engine sums forces of more than 2048 grains block by block.
inline constexpr int results_version = 4;

/// A hash as summary.json holds it: 16 hexadecimal digits, because a JSON number has no 64 bits.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

/// Numbers that the run did not reach are null.
[[nodiscard]] nlohmann::ordered_json summary(const SummaryInput& input);

/// A few lines for people.
[[nodiscard]] std::string digest(const nlohmann::ordered_json& summary);

}  // namespace grainstep::orchestrator
