/// @file What is known of the runs of a study. The state of a study is its runs: there is no other record of it that
/// could disagree with them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "orchestrator/study/plan.hpp"

namespace grainstep::study {

struct Outcome {
  enum class State {
    done,
    failed,    ///< reason and exit_code say why
    open,      ///< not computed yet, or interrupted
    postponed  ///< long, and not asked for
  };
  State state = State::open;
  std::string reason;
  int exit_code = 0;
  std::filesystem::path directory;  ///< of its run
  nlohmann::ordered_json summary;   ///< of a run that is done
  bool computed = false;            ///< by this call, rather than found
};

[[nodiscard]] const char* state_name(Outcome::State state);

/// What the run in `directory` says of the scene with this key. A run counts if its scene and results_version are the
/// wanted ones. A numerical failure counts too: the same scene fails the same way every time. Anything else is open.
[[nodiscard]] Outcome look(const std::filesystem::path& directory, const std::string& key);

/// One outcome per point: its run is looked for in its own directory, anywhere else in the study's (points are renamed)
/// and in `reuse`, directories that hold runs of other studies. An open point gets a directory that holds no run which
/// another point needs.
[[nodiscard]] std::vector<Outcome> locate(const Plan& plan, const std::filesystem::path& root,
                                          const std::vector<std::filesystem::path>& reuse);

}  // namespace grainstep::study
