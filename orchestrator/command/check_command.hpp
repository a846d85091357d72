/// @file grainstep check.
#pragma once

#include "orchestrator/options.hpp"

namespace grainstep::orchestrator {

/// Prints what a scene would be. Throws InputError for a scene that cannot be computed.
void check(const CheckOptions& options);

}  // namespace grainstep::orchestrator
