/// @file From a command line to the options of one command.
#pragma once

#include <optional>

#include "orchestrator/options.hpp"

namespace grainstep::orchestrator {

/// One of the commands with its options; `exit_code` instead where the command line was answered already (--help) or
/// cannot be used (one message was written).
struct CommandLine {
  std::optional<int> exit_code;
  std::optional<RunOptions> run;
  std::optional<CheckOptions> check;
  std::optional<ShowOptions> show;
  std::optional<StudyOptions> study;
  std::optional<ConformanceOptions> conformance;
};

[[nodiscard]] CommandLine parse(int argc, const char* const* argv);

}  // namespace grainstep::orchestrator
