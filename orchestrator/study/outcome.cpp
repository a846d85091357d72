#include "orchestrator/study/outcome.hpp"

#include <map>
#include <set>
#include <system_error>

#include "base/error.hpp"
#include "orchestrator/record/run_facts.hpp"
#include "orchestrator/record/summary.hpp"
#include "results/run_directory.hpp"

namespace grainstep::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int deepest = 4;  // DIR/runs/series/point

/// Directories below `folder` that hold a run.
void find_runs(const fs::path& folder, int depth, std::vector<fs::path>& found) {
  if (results::RunDirectory(folder).holds_a_run()) {
    found.push_back(folder);
  } else if (depth < deepest) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      if (entry.is_directory(error)) find_runs(entry.path(), depth + 1, found);
    }
  }
}

Json summary_of(const fs::path& directory) {
  const fs::path path = results::RunDirectory(directory).summary();
  std::error_code ignored;
  return fs::exists(path, ignored) ? orchestrator::read_summary(path) : Json();
}

bool text_is(const Json& summary, const char* key, const std::string& text) {
  return summary.contains(key) && summary[key].is_string() && summary[key].get<std::string>() == text;
}

/// Directories of runs that are done, by the key of their scene.
std::map<std::string, fs::path> index_runs(const std::vector<fs::path>& folders) {
  std::vector<fs::path> runs;
  for (const fs::path& folder : folders) find_runs(folder, 0, runs);
  std::map<std::string, fs::path> by_key;
  for (const fs::path& run : runs) {
    try {
      const Json summary = summary_of(run);
      if (!summary.contains("scene_key") || !summary["scene_key"].is_string()) continue;
      const auto key = summary["scene_key"].get<std::string>();
      if (look(run, key).state == Outcome::State::done) by_key.emplace(key, run);
    } catch (const InputError&) {  // no summary of ours: nothing to take from it
    }
  }
  return by_key;
}

}  // namespace

const char* state_name(Outcome::State state) {
  switch (state) {
    case Outcome::State::done:
      return "done";
    case Outcome::State::failed:
      return "failed";
    case Outcome::State::open:
      return "open";
    case Outcome::State::postponed:
      break;
  }
  return "long";
}

Outcome look(const fs::path& directory, const std::string& key) {
  Outcome out;
  out.directory = directory;
  Json summary;
  try {
    summary = summary_of(directory);
  } catch (const InputError&) {
    return out;  // damaged: computed again
  }
  const bool ours = text_is(summary, "scene_key", key) && summary.contains("results_version") &&
                    summary["results_version"] == orchestrator::results_version;
  if (!ours) return out;
  if (text_is(summary, "status", "done")) {
    out.state = Outcome::State::done;
    out.summary = std::move(summary);
  } else if (text_is(summary, "status", "failed") &&
             summary.value("exit_code", 0) == static_cast<int>(ExitCode::numerical)) {
    out.state = Outcome::State::failed;
    out.exit_code = static_cast<int>(ExitCode::numerical);
    out.reason = summary.value("reason", "");
  }
  return out;
}

std::vector<Outcome> locate(const Plan& plan, const fs::path& root, const std::vector<fs::path>& reuse) {
  std::vector<fs::path> folders = {root / "runs"};
  folders.insert(folders.end(), reuse.begin(), reuse.end());
  const std::map<std::string, fs::path> by_key = index_runs(folders);
  std::vector<Outcome> outcomes;
  std::set<fs::path> taken;
  for (const PlannedPoint& point : plan.points) {
    Outcome own = look(root / point.directory, point.key);
    if (const auto found = by_key.find(point.key); own.state == Outcome::State::open && found != by_key.end()) {
      own = look(found->second, point.key);
    }
    if (own.state != Outcome::State::open) taken.insert(own.directory);
    outcomes.push_back(std::move(own));
  }
  for (Outcome& outcome : outcomes) {
    if (outcome.state != Outcome::State::open) continue;
    const fs::path wanted = outcome.directory;
    for (int n = 2; taken.contains(outcome.directory); ++n)
      outcome.directory = wanted.string() + "-" + std::to_string(n);
    taken.insert(outcome.directory);
  }
  return outcomes;
}

}  // namespace grainstep::study
