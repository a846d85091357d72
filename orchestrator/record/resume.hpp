/// @file A checkpoint as parts of a file, and what must be the same for a run to go on from it, bit for bit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "orchestrator/session/checkpoint.hpp"
#include "orchestrator/session/hub.hpp"
#include "orchestrator/session/step_plan.hpp"
#include "results/checkpoints.hpp"
#include "results/results_file.hpp"
#include "results/run_directory.hpp"

namespace grainstep::orchestrator {

/// All that decides bits and is not in the states: in the order in which differences are told.
struct About {
  std::uint64_t scene_hash = 0;
  StepPlan plan;
  std::string impactor, structure;  ///< Hello.backend
  int ranks = 1;
};

struct Resume {
  Checkpoint checkpoint;
  results::Contents contents;  ///< of results.h5
  std::string recorder;        ///< its state
  std::string about;           ///< JSON
};

[[nodiscard]] results::Parts parts_of(Resume resume);

/// What is to be kept of a run with a checkpoint.
[[nodiscard]] std::string text_of(const About& about);

/// The latest checkpoint, or that of window `from`. InputError where there is none, or it cannot be read.
[[nodiscard]] Resume load_resume(const results::RunDirectory& directory, std::optional<std::uint64_t> from);

/// InputError for the first difference. `inexact`: another build, instruction set or backend will do.
void require_same(const Resume& resume, const About& now, bool inexact);

}  // namespace grainstep::orchestrator
