/// @file grainstep study.
#pragma once

#include "orchestrator/options.hpp"

namespace grainstep::study {

/// Computes what is open of a study, writes its tables, pictures and page, and returns the program's exit code: 130
/// when interrupted; else that of the first point that failed; else 3 if a finding does not hold; else 0. Call from the
/// main thread, before any other thread exists. @throws InputError before anything is started.
[[nodiscard]] int study(const orchestrator::StudyOptions& options);

}  // namespace grainstep::study
