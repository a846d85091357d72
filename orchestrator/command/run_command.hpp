/// @file grainstep run.
#pragma once

#include "orchestrator/options.hpp"

namespace grainstep::orchestrator {

/// Computes the scene and returns the program's exit code; an error is one message on stderr. Call from the main
/// thread, before any other thread exists.
[[nodiscard]] int run(RunOptions options);

}  // namespace grainstep::orchestrator
