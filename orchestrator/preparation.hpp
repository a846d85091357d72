/// @file A scene as it will be run, known before anything is started: loaded, checked, stepped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "dem-service/preview.hpp"
#include "fe-service/preview.hpp"
#include "grainstep/scene.pb.h"
#include "orchestrator/options.hpp"
#include "orchestrator/step_plan.hpp"
#include "scene/groups.hpp"

namespace grainstep::orchestrator {

struct Preparation {
  scene::Scene scene;
  std::uint64_t hash = 0;
  std::string yaml;  ///< resolved
  scene::Groups groups;
  std::optional<dem::ImpactorPreview> impactor;   ///< nullopt: external
  std::optional<fe::StructurePreview> structure;  ///< nullopt: external
  std::optional<StepPlan> plan;                   ///< nullopt: an external side will say its steps
};

/// Throws InputError for everything about a scene that can be known to be wrong. `options` tells which sides are
/// external.
[[nodiscard]] Preparation prepare(const RunOptions& options);

}  // namespace grainstep::orchestrator
