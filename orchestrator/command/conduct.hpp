/// @file One run over two channels, from Hello to summary.json. Knows nothing of processes: a test passes channels that
/// lead to threads.
#pragma once

#include <functional>
#include <string>

#include "orchestrator/command/ending.hpp"
#include "orchestrator/command/preparation.hpp"
#include "orchestrator/process/save_schedule.hpp"
#include "orchestrator/record/progress.hpp"
#include "orchestrator/record/resume.hpp"
#include "orchestrator/session/hub.hpp"
#include "orchestrator/session/session.hpp"
#include "results/run_directory.hpp"

namespace grainstep::orchestrator {

struct Conduct {
  const Preparation& preparation;
  const results::RunDirectory& directory;  ///< prepared
  Deadlines deadlines;
  Path path = Path::hub;
  bool one_host = true;  ///< Task::one_host
  Progress::Style progress = Progress::Style::quiet;
  int ranks = 1;
  const Resume* resume = nullptr;    ///< what to go on from; nullptr: the start
  bool inexact = false;              ///< require_same()
  SaveSchedule* schedule = nullptr;  ///< of checkpoints; nullptr: there are none
  /// Given the name of a lost peer: what else is known of its end. May be empty.
  std::function<std::string(const std::string&)> account_of;
};

/// Writes everything in the directory, whatever happens, and throws nothing: an exception that nobody foresaw ends the
/// run in the same order as every other one (both sides told, results flushed, summary.json written).
[[nodiscard]] Ending conduct(Hub& hub, const Conduct& how);

/// summary.json of a run that ended before its conversation began.
void write_summary_of(const Ending& ending, const Preparation& preparation, const results::RunDirectory& directory);

}  // namespace grainstep::orchestrator
