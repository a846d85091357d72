/// @file Whether a run fits into this machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "orchestrator/command/preparation.hpp"

namespace grainstep::orchestrator {

/// Estimate of what the local participants take together, bytes; `ranks` of the impactor. External ones take none here.
/// Where snapshots are asked for, those of the elements are in it.
[[nodiscard]] std::uint64_t memory_of(const Preparation& preparation, int ranks);

/// What this machine has, bytes: its memory, or what its control group allows if that is less. nullopt: it does not
/// say. `groups`: where the control group of a container shows itself.
[[nodiscard]] std::optional<std::uint64_t> memory_of_machine(const std::filesystem::path& groups = "/sys/fs/cgroup");

/// Throws InputError where the estimate is more than `machine` has. Several ranks may be on several machines: they only
/// get a warning on stderr.
void require_memory(const Preparation& preparation, int ranks, std::optional<std::uint64_t> machine);

}  // namespace grainstep::orchestrator
