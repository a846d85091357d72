/// @file Which steps both sides take, how they meet, and when extra output is due. Pure; docs/theory/step.md.
#pragma once

#include <cstdint>
#include <string>

#include "grainstep/scene.pb.h"
#include "grainstep/wire.pb.h"

namespace grainstep::orchestrator {

/// What a side says about its steps (Ready, or a preview).
struct SideSteps {
  double stable = 0.0;        ///< s
  double preferred = 0.0;     ///< s
  double contact_mass = 0.0;  ///< kg, of Ready
};

struct StepPlan {
  double impactor_step = 0.0;         ///< s
  double structure_step = 0.0;        ///< s
  std::uint32_t impactor_steps = 1;   ///< per window
  std::uint32_t structure_steps = 1;  ///< per window
  bool structure_fixed = false;       ///< the scene fixed the structure's step
  double window = 0.0;                ///< s
  std::uint64_t windows = 0;
  std::uint64_t report_every = 1;    ///< windows
  std::uint64_t snapshot_every = 0;  ///< windows; 0: none
  std::uint64_t profile_every = 0;   ///< windows; 0: none

  [[nodiscard]] bool equal_steps() const { return impactor_steps == 1 && structure_steps == 1; }
  [[nodiscard]] wire::Start start() const;
};

/// `end` in s. Throws InputError when the scene's steps are not stable, or do not fit each other: with the nearest that
/// do.
[[nodiscard]] StepPlan plan_steps(const scene::Scene& scene, double end, SideSteps impactor, SideSteps structure);

}  // namespace grainstep::orchestrator
