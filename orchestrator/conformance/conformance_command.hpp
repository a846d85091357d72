/// @file grainstep conformance: does a participant keep the protocol? A table of clauses.
#pragma once

#include "orchestrator/options.hpp"

namespace grainstep::conformance {

/// Exit code 0 where nothing failed, else 4. Throws InputError for a scene or a program that cannot be used.
[[nodiscard]] int conformance(const orchestrator::ConformanceOptions& options);

}  // namespace grainstep::conformance
