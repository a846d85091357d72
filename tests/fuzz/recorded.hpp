/// @file Real conversations, as scripts.
#pragma once

#include "grainstep/scene.pb.h"
#include "participant/backend.hpp"
#include "script.pb.h"

namespace grainstep::fuzz {

/// Who said what in one session.
struct Recorded {
  Script impactor;      ///< to the orchestrator
  Script structure;     ///< to the orchestrator
  Script to_impactor;   ///< of the orchestrator
  Script to_structure;  ///< of the orchestrator
};

/// What a session is about.
struct Task {
  const scene::Scene& scene;
  std::uint64_t hash = 0;
  double end = 0.0;  ///< s
};

/// A session of the orchestrator with these two, in threads of their own.
[[nodiscard]] Recorded record(const Task& task, participant::ImpactorBackend& impactor,
                              participant::StructureBackend& structure);

/// One with two honest peers, in three dimensions or two.
[[nodiscard]] Recorded record_honest(const Task& task, unsigned dimension);

}  // namespace grainstep::fuzz
