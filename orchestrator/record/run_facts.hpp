/// @file What the files of a run say, while it runs and afterwards.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "results/run_directory.hpp"

namespace grainstep::orchestrator {

/// summary.json. @throws InputError if it is not a summary.
[[nodiscard]] nlohmann::ordered_json read_summary(const std::filesystem::path& path);

/// A run without a summary. Status by the lock of its directory: "running"; "killed": its process has ended without a
/// chance to write one; "unknown": nothing tells. `progress` from 0 to 1 and ledgers by results.h5, as far as it is
/// there. @throws InputError if the file cannot be read, which of a run that is alive means: not at this moment.
[[nodiscard]] nlohmann::ordered_json read_progress(const results::RunDirectory& directory);

}  // namespace grainstep::orchestrator
