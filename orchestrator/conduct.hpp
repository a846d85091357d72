/// @file One run over two channels, from Hello to summary.json. Knows nothing of processes: a test passes channels that
/// lead to threads.
#pragma once

#include <functional>
#include <string>

#include "base/error.hpp"
#include "orchestrator/hub.hpp"
#include "orchestrator/preparation.hpp"
#include "orchestrator/progress.hpp"
#include "results/run_directory.hpp"

namespace grainstep::orchestrator {

/// How a run ended.
struct Ending {
  ExitCode code = ExitCode::done;
  std::string reason;  ///< empty when done
};

struct Conduct {
  const Preparation& preparation;
  const results::RunDirectory& directory;  ///< prepared
  Deadlines deadlines;
  Progress::Style progress = Progress::Style::quiet;
  /// Given the name of a lost peer: what else is known of its end. May be empty.
  std::function<std::string(const std::string&)> account_of;
};

/// Writes everything in the directory, whatever happens. Does not throw for what can go wrong in a run.
[[nodiscard]] Ending conduct(Hub& hub, const Conduct& how);

}  // namespace grainstep::orchestrator
