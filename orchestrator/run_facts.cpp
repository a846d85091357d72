#include "orchestrator/run_facts.hpp"

#include <chrono>
#include <fstream>

#include "base/error.hpp"
#include "results/hdf5.hpp"

namespace grainstep::orchestrator {
namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

Json read_summary(const std::filesystem::path& path) {
  std::ifstream in(path);
  Json out = Json::parse(in, nullptr, false);
  if (out.is_discarded() || !out.contains("status")) {
    throw InputError(path.string() + ": is not a summary of a run");
  }
  return out;
}

Json read_progress(const std::filesystem::path& path) {
  try {
    const auto file = results::h5::File::read(path);
    const double end = last(file, "/scene/end");
    const double time = last(file, "/series/time");
    return {{"status", "running"},
            {"time", time},
            {"final_time", file.has("/series/t_bar") ? Json(last(file, "/series/t_bar")) : Json(nullptr)},
            {"progress", end > 0.0 ? time / end : 0.0},
            {"energy_drift", last(file, "/ledger/energy_drift")},
            {"momentum_error", last(file, "/ledger/momentum_error")},
            {"seconds_since_written", seconds_since_written(path)}};
  } catch (const OutputError& error) {
    throw InputError(std::string(error.what()) + ". If the run is in progress, ask again.");
  }
}

}  // namespace grainstep::orchestrator
