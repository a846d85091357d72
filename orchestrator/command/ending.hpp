/// @file How a run ended, and what every exception means for that: the one list of them.
#pragma once

#include <string>

#include "base/error.hpp"

namespace grainstep::orchestrator {

struct Ending {
  ExitCode code = ExitCode::done;
  std::string reason;  ///< empty when done
  std::string lost;    ///< the peer that is at fault; empty: none
};

/// To be called in a catch (...): the ending that the exception being handled stands for. One that nobody foresaw (the
/// system refuses memory, a thread, a descriptor) is ExitCode::unforeseen, with the system's own words.
[[nodiscard]] Ending ending_of_current_exception();

}  // namespace grainstep::orchestrator
