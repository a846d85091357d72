#include "orchestrator/run_command.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "orchestrator/conduct.hpp"
#include "orchestrator/interrupted.hpp"
#include "orchestrator/memory.hpp"
#include "orchestrator/participants.hpp"
#include "orchestrator/preparation.hpp"
#include "process/interrupt.hpp"
#include "results/run_directory.hpp"

namespace grainstep::orchestrator {
namespace {

using std::chrono::milliseconds;

results::RunDirectory directory_of(const RunOptions& options) {
  return results::RunDirectory(options.out.empty() ? "runs" / options.scene.scene.stem() : options.out);
}

void announce(const RunOptions& options, const Preparation& preparation, const results::RunDirectory& directory) {
  if (options.quiet) {
    return;
  }
  std::printf("%s\n",
              preparation.scene.title().empty() ? options.scene.scene.c_str() : preparation.scene.title().c_str());
  if (preparation.plan && preparation.impactor && preparation.structure) {
    const StepPlan& plan = *preparation.plan;
    const bool foam = preparation.impactor->elements > 0;
    std::printf(
        "%llu %s, %llu elements, %llu windows of %u and %u steps -> %s\n",
        static_cast<unsigned long long>(foam ? preparation.impactor->elements : preparation.impactor->particles),
        foam ? "foam elements" : "particles", static_cast<unsigned long long>(preparation.structure->elements),
        static_cast<unsigned long long>(plan.windows), plan.impactor_steps, plan.structure_steps,
        directory.path().c_str());
  }
  std::fflush(stdout);
}

Ending run_prepared(const RunOptions& options, const Preparation& preparation, const results::RunDirectory& directory) {
  process::Interrupt interrupt;  // before the first thread
  EventLoop loop;
  loop.add(interrupt.descriptor(), [&interrupt] {
    if (interrupt.raised()) {
      throw Interrupted();
    }
  });
  Participants participants(preparation.scene, options);
  Supervision supervision(loop);
  Hub hub(participants.impactor(), participants.structure(), loop, [&supervision, &participants, &hub] {
    if (hub.impactor().introduced && hub.structure().introduced) {
      participants.close_doors();
    }
    supervision.watch({.impactor = hub.impactor().finished, .structure = hub.structure().finished});
  });
  participants.start(supervision, directory);
  const Ending ending =
      conduct(hub, {.preparation = preparation,
                    .directory = directory,
                    .deadlines = options.deadlines,
                    .progress = Progress::style_for(stdout, options.quiet),
                    .account_of = [&supervision](const std::string& peer) { return supervision.account_of(peer); }});
  supervision.end_all(milliseconds(ending.code == ExitCode::done ? 5000 : 200));
  return ending;
}

}  // namespace

int run(const RunOptions& options) {
  const Preparation preparation = prepare(options);
  print_warnings(preparation);
  require_memory(preparation, options.ranks, memory_of_machine());
  const results::RunDirectory directory = directory_of(options);
  directory.prepare(options.force ? results::Existing::replace : results::Existing::refuse);
  announce(options, preparation, directory);
  const Ending ending = run_prepared(options, preparation, directory);
  if (ending.code != ExitCode::done) {
    std::fprintf(stderr, "grainstep: %s\n", ending.reason.c_str());
  }
  return static_cast<int>(ending.code);
}

}  // namespace grainstep::orchestrator
