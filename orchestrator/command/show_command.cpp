#include "orchestrator/command/show_command.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "orchestrator/record/progress.hpp"
#include "orchestrator/record/run_facts.hpp"
#include "orchestrator/record/summary.hpp"
#include "results/checkpoints.hpp"
#include "results/run_directory.hpp"

namespace grainstep::orchestrator {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string digest_of(const Json& facts, const std::filesystem::path& path) {
  try {
    return digest(facts);
  } catch (const Json::exception& error) {
    throw InputError(path.string() + ": is not a whole summary of a run of this version: " + error.what());
  }
}

// A run that is alive is "running (process 1234 on node17)".
std::string state_text(const Json& facts) {
  const auto status = facts["status"].get<std::string>();
  const auto process = facts["process"].get<std::string>();
  if (status == "running") return process.empty() ? "running" : "running (" + process + ")";
  if (status == "killed") return "ended without a summary: " + process + " was killed, or its machine went down";
  return "without a summary, and nothing tells whether it runs";
}

void print_progress(const Json& facts) {
  const Json& t_bar = facts["final_time"];
  const std::string moment = t_bar.is_number()
                                 ? moment_text(t_bar.get<double>(), 1.0)
                                 : moment_text(facts["time"].get<double>(), std::numeric_limits<double>::quiet_NaN());
  std::printf("%s\n", state_text(facts).c_str());
  std::printf("%.1f%%, %s, energy drift %.2e, momentum error %.1e\n", 100.0 * facts["progress"].get<double>(),
              moment.c_str(), facts["energy_drift"].get<double>(), facts["momentum_error"].get<double>());
  if (facts.contains("seconds_since_written")) {
    std::printf("last written %s ago%s\n", duration_text(facts["seconds_since_written"].get<double>()).c_str(),
                facts["status"] == "killed" ? "" : "; a run that is alive writes about every second once it steps");
  }
}

void print_checkpoints(const results::RunDirectory& directory) {
  const std::vector<std::uint64_t> windows = results::Checkpoints(directory.checkpoints()).windows();
  if (windows.empty()) return;
  std::printf("checkpoints of windows");
  for (const std::uint64_t window : windows) std::printf(" %llu", static_cast<unsigned long long>(window));
  std::printf(": grainstep resume %s goes on from the latest\n", directory.path().c_str());
}

/// Runs below `root`, as far down as studies put them.
std::vector<std::string> runs_below(const fs::path& root) {
  constexpr int deepest = 3;
  std::vector<std::string> found;
  std::error_code error;
  for (auto it = fs::recursive_directory_iterator(root, error); !error && it != fs::recursive_directory_iterator();
       it.increment(error)) {
    if (!it->is_directory(error)) continue;
    if (results::RunDirectory(it->path()).holds_a_run()) {
      found.push_back(it->path().string());
      it.disable_recursion_pending();
    } else if (it.depth() >= deepest) {
      it.disable_recursion_pending();
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Where no run is.
std::string what_is_there(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return "no such directory";
  if (!fs::is_directory(path, error)) return "is a file; expected the directory of a run";
  const auto runs = runs_below(path);
  const std::string nearest = runs.empty() ? "" : ", e.g. grainstep show '" + runs.front() + "'";
  const std::string count = std::to_string(runs.size());
  if (fs::exists(path / "study.json", error) || fs::exists(path / "study.lock", error)) {
    return "holds a study, not a run: its results are in table.csv, and " + count + " of its runs can be shown" +
           nearest;
  }
  if (!runs.empty()) return "holds no run itself, but " + count + " below it" + nearest;
  return "holds no run (no summary.json, no results.h5)";
}

}  // namespace

void show(const ShowOptions& options) {
  const results::RunDirectory directory(options.directory);
  if (!directory.holds_a_run() && directory.occupation().state != results::Occupation::State::held) {
    throw InputError(options.directory.string() + ": " + what_is_there(options.directory));
  }
  const bool ended = std::filesystem::exists(directory.summary());
  const Json facts = ended ? read_summary(directory.summary()) : read_progress(directory);
  if (options.json) {
    std::printf("%s\n", facts.dump(2).c_str());
  } else if (ended) {
    std::fputs(digest_of(facts, directory.summary()).c_str(), stdout);
  } else {
    print_progress(facts);
  }
  if (!options.json && facts["status"] != "done") print_checkpoints(directory);
}

}  // namespace grainstep::orchestrator
