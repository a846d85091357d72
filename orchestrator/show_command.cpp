#include "orchestrator/show_command.hpp"

#include <cstdio>
#include <limits>
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

void print_progress(const Json& progress) {
  const Json& t_bar = progress["final_time"];
  const std::string moment =
      t_bar.is_number() ? moment_text(t_bar.get<double>(), 1.0)
                        : moment_text(progress["time"].get<double>(), std::numeric_limits<double>::quiet_NaN());
  std::printf("running: %.1f%%, %s, energy drift %.2e, momentum error %.1e\n",
              100.0 * progress["progress"].get<double>(), moment.c_str(), progress["energy_drift"].get<double>(),
              progress["momentum_error"].get<double>());
  std::printf("last written %s ago; a run that is alive writes about every second once it steps\n",
              duration_text(progress["seconds_since_written"].get<double>()).c_str());
}

}  // namespace

void show(const ShowOptions& options) {
  const results::RunDirectory directory(options.directory);
  if (!directory.holds_a_run()) {
    throw InputError(options.directory.string() + ": holds no run (no summary.json, no results.h5)");
  }
  const bool ended = std::filesystem::exists(directory.summary());
  const Json facts = ended ? read_summary(directory.summary()) : read_progress(directory.results());
  if (options.json) {
    std::printf("%s\n", facts.dump(2).c_str());
  } else if (ended) {
    std::fputs(digest_of(facts, directory.summary()).c_str(), stdout);
  } else {
    print_progress(facts);
  }
}

}  // namespace grainstep::orchestrator
