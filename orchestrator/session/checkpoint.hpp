/// @file What a run can go on from: both sides' states at the end of one window, and what lies between them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grainstep::orchestrator {

struct Checkpoint {
  std::uint64_t window = 0;
  std::string impactor, structure;  ///< bytes that only they understand
  std::vector<double> surface;      ///< m, nodes x dimension: where it is at the end of this window
};

}  // namespace grainstep::orchestrator
