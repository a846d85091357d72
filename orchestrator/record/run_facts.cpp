#include "orchestrator/record/run_facts.hpp"

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

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

const char* status_of(const results::Occupation& occupation) {
  using State = results::Occupation::State;
  if (occupation.state == State::held) return "running";
  return occupation.state == State::left ? "killed" : "unknown";
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

Json read_progress(const results::RunDirectory& directory) {
  const results::Occupation occupation = directory.occupation();
  Json out = {{"status", status_of(occupation)},
              {"process", occupation.holder},
              {"time", 0.0},
              {"final_time", 0.0},
              {"progress", 0.0},
              {"energy_drift", 0.0},
              {"momentum_error", 0.0}};
  const std::filesystem::path path = directory.results();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return out;
  try {
    const auto file = results::h5::File::read(path);
    const double end = last(file, "/scene/end");
    const double time = last(file, "/series/time");
    out["time"] = time;
    out["final_time"] = file.has("/series/t_bar") ? Json(last(file, "/series/t_bar")) : Json(nullptr);
    out["progress"] = end > 0.0 ? time / end : 0.0;
    out["energy_drift"] = last(file, "/ledger/energy_drift");
    out["momentum_error"] = last(file, "/ledger/momentum_error");
    out["seconds_since_written"] = seconds_since_written(path);
  } catch (const OutputError& error) {
    throw InputError(std::string(error.what()) + (occupation.state == results::Occupation::State::left
                                                      ? ". Its run (" + occupation.holder +
                                                            ") was killed, perhaps while it wrote: compute it again "
                                                            "with --force."
                                                      : ". If the run is in progress, ask again."));
  }
  return out;
}

}  // namespace grainstep::orchestrator
