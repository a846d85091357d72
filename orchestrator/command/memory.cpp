#include "orchestrator/command/memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

#include "base/error.hpp"
#include "scene/fineness.hpp"

namespace grainstep::orchestrator {
namespace {

/// Of an element in a snapshot: half a node with three vectors, three indices, four fields; as a message and its bytes,
/// at the participant and at the orchestrator.
constexpr std::uint64_t snapshot_bytes = 4ULL * (24 + 12 + 32);

std::string gibibytes(std::uint64_t bytes) {
  char out[32];
  std::snprintf(out, sizeof out, "%.3g GiB", static_cast<double>(bytes) / (1U << 30U));
  return out;
}

/// Limit of the control group that a container is, bytes. A group without one says "max", or a number beyond all
/// memory.
std::optional<std::uint64_t> limit_of_group(const std::filesystem::path& groups) {
  for (const char* path : {"memory.max", "memory/memory.limit_in_bytes"}) {
    std::ifstream file(groups / path);
    std::uint64_t limit = 0;
    if (file >> limit) return limit;
  }
  return std::nullopt;
}

/// What a side's snapshots take beside it; particles' are counted in what they say themselves.
std::uint64_t memory_of_snapshots(const wire::Ready& side) {
  return side.counted() == "elements" ? snapshot_bytes * side.size() : 0;
}

}  // namespace

std::uint64_t memory_of(const Preparation& p, int ranks) {
  std::uint64_t bytes = 0;
  if (p.impactor) bytes += p.impactor->memory() + static_cast<std::uint64_t>(ranks - 1) * p.impactor->rank_memory();
  if (p.structure) bytes += p.structure->memory();
  if (p.scene.output().snapshots() == 0) return bytes;
  for (const auto* side : {&p.impactor, &p.structure}) {
    if (*side) bytes += memory_of_snapshots(**side);
  }
  return bytes;
}

std::optional<std::uint64_t> memory_of_machine(const std::filesystem::path& groups) {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page = sysconf(_SC_PAGE_SIZE);
  const std::optional<std::uint64_t> limit = limit_of_group(groups);
  if (pages <= 0 || page <= 0) return limit;
  const std::uint64_t all = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
  return std::min(all, limit.value_or(all));
}

void require_memory(const Preparation& p, int ranks, std::optional<std::uint64_t> machine) {
  const std::uint64_t needed = memory_of(p, ranks);
  if (!machine || needed <= *machine) return;
  const std::uint64_t of_impactor = p.impactor ? p.impactor->memory() : 0;
  const bool structure = p.structure && p.structure->memory() > of_impactor;
  const scene::Fineness fineness =
      structure ? scene::fineness_of(p.scene.structure()) : scene::fineness_of(p.scene.impactor());
  const char* change = fineness.finer_is_larger ? "lower" : "raise";
  const std::string text = fineness.key + ": the run would take about " + gibibytes(needed) +
                           " of memory, snapshots included, but this machine has " + gibibytes(*machine) + "; " +
                           change + " it, or run on a larger machine";
  if (ranks == 1) throw InputError(text);
  std::fprintf(stderr, "grainstep: warning: %s\n", text.c_str());
}

}  // namespace grainstep::orchestrator
