/// @file What the participants themselves say of a scene: they are started, told their part of it, hear Stop in place
/// of Start, and are gone.
#pragma once

#include <optional>

#include "grainstep/scene.pb.h"
#include "orchestrator/options.hpp"
#include "orchestrator/process/threads.hpp"

namespace grainstep::orchestrator {

/// nullopt: that side is started by somebody else.
struct Answers {
  std::optional<wire::Ready> impactor;
  std::optional<wire::Ready> structure;
  TakesThreads takes_threads;
};

/// Throws what a participant's Error stands for (InputError for a scene that it cannot compute), PeerError for one that
/// does not answer as it should.
[[nodiscard]] Answers ask(const scene::Scene& scene, std::uint64_t hash, const RunOptions& options);

}  // namespace grainstep::orchestrator
