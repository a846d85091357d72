#include "orchestrator/show_command.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "orchestrator/progress.hpp"
#include "orchestrator/run_facts.hpp"
#include "orchestrator/summary.hpp"
#include "results/run_directory.hpp"

namespace grainstep::orchestrator {
namespace {

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
  std::printf("%s\n", state_text(facts).c_str());
  std::printf("%.1f%%, t_bar %.3f, energy drift %.2e, momentum error %.1e\n", 100.0 * facts["progress"].get<double>(),
              facts["final_time"].get<double>(), facts["energy_drift"].get<double>(),
              facts["momentum_error"].get<double>());
  if (facts.contains("seconds_since_written")) {
    std::printf("last written %s ago%s\n", duration_text(facts["seconds_since_written"].get<double>()).c_str(),
                facts["status"] == "killed" ? "" : "; a run that is alive writes about every second once it steps");
  }
}

}  // namespace

void show(const ShowOptions& options) {
  const results::RunDirectory directory(options.directory);
  if (!directory.holds_a_run() && directory.occupation().state != results::Occupation::State::held) {
    throw InputError(options.directory.string() + ": holds no run (no summary.json, no results.h5)");
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
}

}  // namespace grainstep::orchestrator
