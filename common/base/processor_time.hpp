/// @file Processor time of this process: what a run cost, whoever else used the machine meanwhile.
#pragma once

#include <ctime>

namespace grainstep {

/// Seconds of all threads of this process so far.
[[nodiscard]] inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace grainstep
