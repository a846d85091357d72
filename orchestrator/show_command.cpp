#include "orchestrator/show_command.hpp"

#include <chrono>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "orchestrator/progress.hpp"
#include "orchestrator/summary.hpp"
#include "results/hdf5.hpp"
#include "results/run_directory.hpp"

namespace grainstep::orchestrator {
namespace {

using Json = nlohmann::ordered_json;

Json read_summary(const std::filesystem::path& path) {
  std::ifstream in(path);
  Json out = Json::parse(in, nullptr, false);
  if (out.is_discarded() || !out.contains("status")) {
    throw InputError(path.string() + ": is not a summary of a run");
  }
  return out;
}

std::string digest_of(const Json& facts, const std::filesystem::path& path) {
  try {
    return digest(facts);
  } catch (const Json::exception& error) {
    throw InputError(path.string() + ": is not a whole summary of a run of this version: " + error.what());
  }
}

double last(const results::h5::File& file, const std::string& dataset) {
  if (!file.has(dataset)) {
    return 0.0;
  }
  const std::vector<double> values = file.read_doubles(dataset);
  return values.empty() ? 0.0 : values.back();
}

double seconds_since_written(const std::filesystem::path& path) {
  const auto age = std::filesystem::file_time_type::clock::now() - std::filesystem::last_write_time(path);
  return std::chrono::duration<double>(age).count();
}

// A run without a summary is in progress, or its orchestrator was ended without a chance to write one.
Json read_progress(const std::filesystem::path& path) {
  try {
    const auto file = results::h5::File::read(path);
    const double end = last(file, "/scene/end");
    const double time = last(file, "/series/time");
    return {{"status", "running"},
            {"time", time},
            {"final_time", last(file, "/series/t_bar")},
            {"progress", end > 0.0 ? time / end : 0.0},
            {"energy_drift", last(file, "/ledger/energy_drift")},
            {"momentum_error", last(file, "/ledger/momentum_error")},
            {"seconds_since_written", seconds_since_written(path)}};
  } catch (const OutputError& error) {
    throw InputError(std::string(error.what()) + ". If the run is in progress, ask again.");
  }
}

void print_progress(const Json& progress) {
  std::printf("running: %.1f%%, t_bar %.3f, energy drift %.2e, momentum error %.1e\n",
              100.0 * progress["progress"].get<double>(), progress["final_time"].get<double>(),
              progress["energy_drift"].get<double>(), progress["momentum_error"].get<double>());
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
