/// @file grainstep show.
#pragma once

#include "orchestrator/options.hpp"

namespace grainstep::orchestrator {

/// Prints what a run says. Throws InputError when the directory holds none.
void show(const ShowOptions& options);

}  // namespace grainstep::orchestrator
