/// @file What the files of a run say, while it runs and afterwards.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace grainstep::orchestrator {

/// summary.json. @throws InputError if it is not a summary.
[[nodiscard]] nlohmann::ordered_json read_summary(const std::filesystem::path& path);

/// results.h5 of a run without a summary: it is in progress, or its orchestrator was ended without a chance to write
/// one. Status "running", `progress` from 0 to 1, ledgers. @throws InputError if the file cannot be read at this
/// moment.
[[nodiscard]] nlohmann::ordered_json read_progress(const std::filesystem::path& path);

}  // namespace grainstep::orchestrator
