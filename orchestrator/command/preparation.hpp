/// @file A scene as it will be run, known before the run is started: loaded, checked, its participants asked, stepped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grainstep/scene.pb.h"
#include "grainstep/wire.pb.h"
#include "orchestrator/options.hpp"
#include "orchestrator/process/threads.hpp"
#include "orchestrator/session/step_plan.hpp"
#include "scene/groups.hpp"
#include "scene/rules.hpp"

namespace grainstep::orchestrator {

struct Preparation {
  scene::Scene scene;
  std::uint64_t hash = 0;
  std::string yaml;  ///< resolved
  std::vector<scene::Finding> warnings;
  scene::Groups groups;
  std::optional<wire::Ready> impactor;   ///< as it said when asked; nullopt: external
  std::optional<wire::Ready> structure;  ///< the same
  std::optional<StepPlan> plan;          ///< nullopt: an external side will say its steps
  ThreadShares threads;
};

/// Throws InputError for everything about a scene that can be known to be wrong, PeerError for a participant that does
/// not answer as it should. `options` tells which sides are external.
[[nodiscard]] Preparation prepare(const RunOptions& options);

/// The same for a scene that is loaded already; of `options.scene` only the overrides are looked at.
[[nodiscard]] Preparation prepare(scene::Scene scene, const RunOptions& options);

/// The first half of it: everything but what the participants say. The second: asks them.
[[nodiscard]] Preparation prepare_unasked(scene::Scene scene, const RunOptions& options);
void ask_participants(Preparation& preparation, const RunOptions& options);

/// To stderr, a line each: check, run and study say the same before anything starts. `of`: which scene, in front.
void print_warnings(const Preparation& preparation, const std::string& of = "");

/// Those of a plan alone, where it was made only with what an external side said.
void print_warnings(const StepPlan& plan, const std::string& of = "");

/// Whether what it counts are particles, and it has some: their mass is that of the groups.
[[nodiscard]] bool is_of_particles(const wire::Ready& ready);

/// Of both sides; nothing where an external one does not say.
[[nodiscard]] std::optional<Cost> cost_of(const Preparation& preparation);

}  // namespace grainstep::orchestrator
