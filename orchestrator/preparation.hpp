/// @file A scene as it will be run, known before anything is started: loaded, checked, stepped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fe-service/preview.hpp"
#include "grainstep/scene.pb.h"
#include "orchestrator/options.hpp"
#include "orchestrator/step_plan.hpp"
#include "scene/groups.hpp"
#include "scene/rules.hpp"

namespace grainstep::orchestrator {

/// What an impactor will be, whatever its kind. Steps in s.
struct ImpactorPreview {
  std::uint64_t particles = 0;
  std::uint64_t elements = 0;            ///< of a foam projectile
  double mass = 0.0;                     ///< kg, of its particles, of what is modelled; 0: it has none
  double smallest = 0.0, largest = 0.0;  ///< m, diameters of particles
  double contact_mass = 0.0;             ///< kg, the heaviest that touches at one point
  double contact_time = 0.0;             ///< s, between two of the smallest particles; 0: it has no contacts
  double longest_window = 0.0;           ///< s; 0: no limit of its own
  double stable_step = 0.0;
  double preferred_step = 0.0;
  std::uint64_t memory_bytes = 0;
  std::uint64_t process_bytes = 0;  ///< the part of it that every rank takes, whatever its share of particles
  double seconds_per_step = 0.0;    ///< estimate, one core
};

struct Preparation {
  scene::Scene scene;
  std::uint64_t hash = 0;
  std::string yaml;  ///< resolved
  std::vector<scene::Finding> warnings;
  scene::Groups groups;
  std::optional<ImpactorPreview> impactor;        ///< nullopt: external
  std::optional<fe::StructurePreview> structure;  ///< nullopt: external
  std::optional<StepPlan> plan;                   ///< nullopt: an external side will say its steps
};

/// Throws InputError for everything about a scene that can be known to be wrong. `options` tells which sides are
/// external.
[[nodiscard]] Preparation prepare(const RunOptions& options);

/// The same for a scene that is loaded already; `options.scene` is not looked at.
[[nodiscard]] Preparation prepare(scene::Scene scene, const RunOptions& options);

/// To stderr, a line each: check, run and study say the same before anything starts. `of`: which scene, in front.
void print_warnings(const Preparation& preparation, const std::string& of = "");

/// Those of a plan alone, where it was made only with what an external side said.
void print_warnings(const StepPlan& plan, const std::string& of = "");

/// Seconds that both sides compute, each on a core of its own; nothing where an external side does not say.
struct Cost {
  double impactor = 0.0;
  double structure = 0.0;
};
[[nodiscard]] std::optional<Cost> cost_of(const Preparation& preparation);

}  // namespace grainstep::orchestrator
