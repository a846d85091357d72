#include "orchestrator/conformance/conformance_command.hpp"

#include <algorithm>
#include <cstdio>

#include "base/error.hpp"
#include "declare/suggest.hpp"
#include "orchestrator/conformance/trial.hpp"
#include "process/launch.hpp"
#include "scene/load.hpp"
#include "scene/needs.hpp"

namespace grainstep::conformance {
namespace {

/// What is asked of a participant that has settings of its own, if any.
scene::Scene scene_without_a_file() {
  scene::Scene out;
  out.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  out.set_depth(1e-3);
  out.mutable_structure()->set_type(scene::Structure::TYPE_EXTERNAL);
  out.mutable_structure()->set_extent(scene::Structure::EXTENT_FULL);
  out.mutable_impactor()->set_type(scene::Impactor::TYPE_EXTERNAL);
  return out;
}

process::Command command_of(const orchestrator::ConformanceOptions& options, const scene::Scene& scene,
                            wire::Role role) {
  std::vector<std::string> words = options.command;
  if (words.empty()) words = scene::program_of(scene, role).command;
  if (words.empty()) {
    throw InputError(
        "conformance: whose? Write the participant's command behind --, as in: grainstep conformance "
        "--role structure -- ./my-solver");
  }
  return {.program = process::find_program(words.front()),
          .arguments = {words.begin() + 1, words.end()},
          .environment = {}};
}

struct Count {
  int passed = 0, failed = 0, not_offered = 0;
};

void try_one(const Trial& trial, const Bench& bench, Count& count) {
  const auto say = [&trial](const char* outcome, const std::string& found) {
    std::printf("%-11s  %-18s  %s [%s]\n", outcome, trial.name, trial.clause, trial.paragraph);
    if (!found.empty()) std::printf("%-11s  %-18s  %s\n", "", "", found.c_str());
    std::fflush(stdout);
  };
  try {
    trial.run(bench);
    ++count.passed;
    say("passed", "");
  } catch (const NotOffered& reason) {
    ++count.not_offered;
    say("not offered", reason.what());
  } catch (const Breach& breach) {
    ++count.failed;
    say("failed", breach.what());
  }
}

void check_only(const std::vector<std::string>& only, const std::vector<Trial>& trials) {
  std::vector<std::string> names;
  for (const Trial& trial : trials) names.emplace_back(trial.name);
  for (const std::string& name : only) {
    if (std::ranges::find(names, name) != names.end()) continue;
    throw InputError("--only " + name + ": no such clause" + declare::hint(name, names) +
                     " Clauses: " + declare::join_words(names));
  }
}

}  // namespace

int conformance(const orchestrator::ConformanceOptions& options) {
  Bench bench;
  bench.role = options.role == "structure" ? wire::STRUCTURE : wire::IMPACTOR;
  bench.scene =
      options.scene.scene.empty() ? scene_without_a_file() : scene::load_scene(options.scene.scene, options.scene.set);
  bench.command = command_of(options, bench.scene, bench.role);
  bench.patience_s = options.patience_s;
  const std::vector<Trial> trials = trials_of(bench.role);
  check_only(options.only, trials);
  Count count;
  for (const Trial& trial : trials) {
    if (options.only.empty() || std::ranges::find(options.only, trial.name) != options.only.end()) {
      try_one(trial, bench, count);
    }
  }
  std::printf("%d passed, %d failed, %d not offered (paragraphs are those of proto/README.md)\n", count.passed,
              count.failed, count.not_offered);
  return static_cast<int>(count.failed == 0 ? ExitCode::done : ExitCode::peer);
}

}  // namespace grainstep::conformance
