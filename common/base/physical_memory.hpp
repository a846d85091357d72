/// @file How much memory this machine has.
#pragma once

#include <unistd.h>

#include <limits>

namespace grainstep {

/// Bytes; no limit where the system does not say.
[[nodiscard]] inline double physical_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGE_SIZE);
  if (pages <= 0 || page <= 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(pages) * static_cast<double>(page);
}

}  // namespace grainstep
