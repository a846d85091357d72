/// @file Which steps both sides take, how they meet, and when extra output is due. Pure; docs/theory/step.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grainstep/scene.pb.h"
#include "grainstep/wire.pb.h"

namespace grainstep::orchestrator {

/// What a side says about its steps (wire.proto, Ready), or would say.
struct SideSteps {
  double stable = 0.0;          ///< s
  double preferred = 0.0;       ///< s
  double contact_mass = 0.0;    ///< kg
  double contact_time = 0.0;    ///< s, impactor; 0: no contacts
  double longest_window = 0.0;  ///< s; 0: no limit
  double free_mass = 0.0;       ///< kg, structure; 0: deformable or held
};

[[nodiscard]] SideSteps steps_of(const wire::Ready& ready);

struct StepPlan {
  double impactor_step = 0.0;         ///< s
  double structure_step = 0.0;        ///< s
  std::uint32_t impactor_steps = 1;   ///< per window
  std::uint32_t structure_steps = 1;  ///< per window
  bool structure_fixed = false;       ///< the scene fixed the structure's step
  double window = 0.0;                ///< s
  std::uint64_t windows = 0;
  double report_every = 1.0;          ///< windows, on the mean (Start)
  double snapshot_every = 0.0;        ///< windows; 0: none
  double profile_every = 0.0;         ///< windows; 0: none
  std::vector<std::string> warnings;  ///< what of the scene's wishes cannot be had

  [[nodiscard]] bool equal_steps() const { return impactor_steps == 1 && structure_steps == 1; }
  [[nodiscard]] wire::Start start() const;
};

/// `end` in s. Throws InputError when the scene's steps are not stable, or do not fit each other: with the nearest that
/// do.
[[nodiscard]] StepPlan plan_steps(const scene::Scene& scene, double end, SideSteps impactor, SideSteps structure);

}  // namespace grainstep::orchestrator
