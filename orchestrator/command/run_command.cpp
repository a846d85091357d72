#include "orchestrator/command/run_command.hpp"

#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "orchestrator/command/conduct.hpp"
#include "orchestrator/command/memory.hpp"
#include "orchestrator/command/preparation.hpp"
#include "orchestrator/process/interrupted.hpp"
#include "orchestrator/process/participants.hpp"
#include "orchestrator/process/save_schedule.hpp"
#include "orchestrator/record/resume.hpp"
#include "orchestrator/session/saving.hpp"
#include "process/interrupt.hpp"
#include "results/checkpoints.hpp"
#include "results/run_directory.hpp"

namespace grainstep::orchestrator {
namespace {

using std::chrono::milliseconds;

// For participants to end by themselves. Both waits end with the processes; only one that hangs uses them up.
constexpr milliseconds patience_at_the_end{30'000};
constexpr milliseconds patience_after_a_failure{200};

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
    std::printf("%llu %s, %llu %s, %llu windows of %u and %u steps -> %s\n",
                static_cast<unsigned long long>(preparation.impactor->size()), preparation.impactor->counted().c_str(),
                static_cast<unsigned long long>(preparation.structure->size()),
                preparation.structure->counted().c_str(), static_cast<unsigned long long>(plan.windows),
                plan.impactor_steps, plan.structure_steps, directory.path().c_str());
  }
  std::fflush(stdout);
}

Path path_of(const RunOptions& options) {
  for (const Path path : {Path::hub, Path::shared, Path::direct}) {
    if (options.path == text_of(path)) return path;
  }
  return Path::shortest;
}

/// Those that somebody else has started may sit in containers: they share this host's memory only on a user's word.
bool on_one_host(const RunOptions& options, const scene::Scene& scene) {
  return !is_external(wire::IMPACTOR, scene, options) && !is_external(wire::STRUCTURE, scene, options);
}

/// Before they compute there is nothing to save.
bool can_be_saved(Hub& hub) { return hub.impactor().under_way && hub.structure().under_way && Saving(hub).possible(); }

Ending run_prepared(const RunOptions& options, const Preparation& preparation, const results::RunDirectory& directory,
                    const Resume* resume) {
  process::Interrupt interrupt;  // before the first thread
  EventLoop loop;
  SaveSchedule schedule(options.checkpoint_every_s);
  Hub* talking = nullptr;
  loop.add(interrupt.descriptor(), [&] {
    const bool can = talking != nullptr && can_be_saved(*talking);
    if (interrupt.raised()) {
      if (!can) throw Interrupted();
      schedule.end_after_next();
    } else if (interrupt.asked()) {
      if (can) schedule.save_now();
      if (!can) std::fprintf(stderr, "grainstep: SIGUSR1: no checkpoint: nothing to save yet, or a side that cannot\n");
    }
  });
  Participants participants(preparation.scene, options, preparation.threads);
  Supervision supervision(loop);
  Hub hub(participants.impactor(), participants.structure(), loop, [&supervision, &participants, &hub] {
    if (hub.impactor().under_way && hub.structure().under_way) participants.close_doors();
    supervision.watch({.impactor = {hub.impactor().introduced, hub.impactor().finished},
                       .structure = {hub.structure().introduced, hub.structure().finished}});
  });
  talking = &hub;
  participants.start(supervision, directory.logs());
  Ending ending =
      conduct(hub, {.preparation = preparation,
                    .directory = directory,
                    .deadlines = options.deadlines,
                    .path = path_of(options),
                    .one_host = on_one_host(options, preparation.scene),
                    .progress = Progress::style_for(stdout, options.quiet),
                    .ranks = options.ranks,
                    .resume = resume,
                    .inexact = options.inexact,
                    .schedule = &schedule,
                    .account_of = [&supervision](const std::string& peer) { return supervision.account_of(peer); }});
  supervision.end_all(ending.code == ExitCode::done ? patience_at_the_end : patience_after_a_failure);
  return ending;
}

/// What nobody foresaw is the end of this run like every other one. Where nothing was computed yet and a user can mend
/// it (a program that is not there), it is refused as before the run.
Ending run_to_its_end(const RunOptions& options, const Preparation& preparation, const results::RunDirectory& directory,
                      const Resume* resume) {
  try {
    return run_prepared(options, preparation, directory, resume);
  } catch (const InputError&) {
    throw;
  } catch (...) {
    Ending ending = ending_of_current_exception();
    try {
      write_summary_of(ending, preparation, directory);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "grainstep: no summary could be written: %s\n", error.what());
    }
    return ending;
  }
}

void say_that_it_goes_on(const Ending& ending, const Resume* from, int time, int of) {
  const std::string where = from == nullptr ? "begins anew, there is no checkpoint yet"
                                            : "goes on from window " + std::to_string(from->checkpoint.window);
  std::fprintf(stderr, "grainstep: %s\ngrainstep: the run %s (%d of %d times)\n", ending.reason.c_str(), where.c_str(),
               time, of);
}

/// And again, as often as the user wants, where a participant is lost: both are started anew.
Ending run_in_spite_of_losses(const RunOptions& options, const Preparation& preparation,
                              const results::RunDirectory& directory, std::optional<results::DirectoryLock>& lock,
                              const Resume* from) {
  Ending ending = run_to_its_end(options, preparation, directory, from);
  for (int time = 1; ending.code == ExitCode::peer && time <= options.retry; ++time) {
    std::optional<Resume> latest;
    if (!results::Checkpoints(directory.checkpoints()).windows().empty()) {
      latest = load_resume(directory, std::nullopt);
    } else {
      lock.reset();  // it is taken again by who empties the directory
      lock.emplace(directory.prepare(results::Existing::replace));
    }
    say_that_it_goes_on(ending, latest ? &*latest : nullptr, time, options.retry);
    ending = run_to_its_end(options, preparation, directory, latest ? &*latest : nullptr);
  }
  return ending;
}

/// Says why, and how it can go on.
int exit_with(const Ending& ending, const results::RunDirectory& directory) {
  if (ending.code == ExitCode::done) return 0;
  std::fprintf(stderr, "grainstep: %s\n", ending.reason.c_str());
  const std::vector<std::uint64_t> saved = results::Checkpoints(directory.checkpoints()).windows();
  if (!saved.empty()) {
    std::fprintf(stderr, "grainstep resume %s goes on from window %llu\n", directory.path().c_str(),
                 static_cast<unsigned long long>(saved.back()));
  }
  return static_cast<int>(ending.code);
}

/// A participant that is lost while it is asked is asked again, as often as the user wants in the whole run.
Preparation asked(RunOptions& options) {
  while (true) {
    try {
      return prepare(options);
    } catch (const PeerError& lost) {
      if (options.retry == 0) throw;
      --options.retry;
      std::fprintf(stderr, "grainstep: %s\ngrainstep: the participants are asked again (%d times more, if need be)\n",
                   lost.what(), options.retry);
    }
  }
}

/// A scene that can be computed here. InputError otherwise.
Preparation prepared(RunOptions& options) {
  Preparation preparation = asked(options);
  print_warnings(preparation);
  require_memory(preparation, options.ranks, memory_of_machine());
  return preparation;
}

int resume_run(RunOptions options) {
  const results::RunDirectory directory(options.out);
  if (!directory.holds_a_run()) throw InputError(directory.path().string() + ": holds no run to go on with");
  std::optional<results::DirectoryLock> lock(directory.prepare(results::Existing::go_on));
  const Resume resume = load_resume(directory, options.from);
  options.scene.scene = directory.scene();
  const Preparation preparation = prepared(options);
  announce(options, preparation, directory);
  return exit_with(run_in_spite_of_losses(options, preparation, directory, lock, &resume), directory);
}

}  // namespace

int run(RunOptions options) {
  if (options.resume) return resume_run(std::move(options));
  const Preparation preparation = prepared(options);
  const results::RunDirectory directory = directory_of(options);
  std::optional<results::DirectoryLock> lock(
      directory.prepare(options.force ? results::Existing::replace : results::Existing::refuse));
  announce(options, preparation, directory);
  return exit_with(run_in_spite_of_losses(options, preparation, directory, lock, nullptr), directory);
}

}  // namespace grainstep::orchestrator
