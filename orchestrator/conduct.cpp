#include "orchestrator/conduct.hpp"

#include <cstdio>
#include <memory>
#include <optional>

#include "base/processor_time.hpp"
#include "orchestrator/background_observer.hpp"
#include "orchestrator/build_info.hpp"
#include "orchestrator/interrupted.hpp"
#include "orchestrator/participants.hpp"
#include "orchestrator/recorder.hpp"
#include "orchestrator/session.hpp"
#include "orchestrator/summary.hpp"
#include "results/atomic_file.hpp"

namespace grainstep::orchestrator {
namespace {

std::vector<results::Text> texts(const Preparation& preparation) {
  const BuildInfo& build = build_info();
  return {{"/scene/yaml", "the resolved scene", preparation.yaml},
          {"/scene/hash", "XXH3 of the resolved scene", std::to_string(preparation.hash)},
          {"/scene/title", "the scene's title", preparation.scene.title()},
          {"/build/version", "version of grainstep", build.version},
          {"/build/commit", "commit of the sources", build.commit},
          {"/build/compiler", "compiler", build.compiler},
          {"/build/isa", "instruction set of the machine", build.isa}};
}

/// The parts of a run that its end needs to know.
class Run {
 public:
  Run(Hub& hub, const Conduct& how)
      : hub_(hub),
        how_(how),
        session_(hub, {.scene = how.preparation.scene, .hash = how.preparation.hash, .end = how.preparation.groups.end},
                 how.deadlines) {}

  void go() {
    const Preparation& p = how_.preparation;
    results::write_atomically(how_.directory.scene(), p.yaml);
    file_.emplace(how_.directory.results(), texts(p));
    file_->add(results::Array{
        .dataset = "/scene/end", .meaning = {"s", "when the run is to end"}, .values = {p.groups.end}, .indices = {}});
    session_.introduce();
    plan_ = session_.prepare();
    if (!p.plan) print_warnings(*plan_);  // an external side has told its steps only now
    const double mass = hub_.impactor().ready.mass();
    if (has_particles(p.scene) && mass > 0.0) groups_ = scene::groups(p.scene, mass);
    progress_.emplace(stdout, how_.progress, Progress::Scale{plan_->windows, plan_->window, groups_.reference_time});
    recorder_.emplace(Recorder::Context{.scene = p.scene,
                                        .groups = groups_,
                                        .plan = *plan_,
                                        .surface = hub_.structure().ready.surface(),
                                        .masses = {hub_.impactor().ready.mass(), hub_.structure().ready.mass()}},
                      how_.directory, *file_, [this](std::uint64_t window) { progress_->tick(window); });
    background_.emplace(*recorder_);
    session_.run(*plan_, *background_);
  }

  /// Runs go() and turns whatever ends it into an Ending; the other side is told.
  Ending end() {
    try {
      go();
      return keep({});
    } catch (const PeerError& error) {
      std::string reason = error.what() + own_part();
      if (how_.account_of) {
        if (const std::string account = how_.account_of(error.peer()); !account.empty()) {
          reason += "; " + account;
        }
      }
      return abandon({ExitCode::peer, reason}, error.peer());
    } catch (const InputError& error) {
      return abandon({ExitCode::bad_input, error.what()});
    } catch (const NumericalError& error) {
      return abandon({ExitCode::numerical, error.what()});
    } catch (const OutputError& error) {
      return abandon({ExitCode::output, error.what()});
    } catch (const Interrupted& error) {
      return abandon({ExitCode::interrupted, error.what()});
    }
  }

  [[nodiscard]] nlohmann::ordered_json summary_of(const Ending& ending) const {
    const std::string status = ending.code == ExitCode::done          ? "done"
                               : ending.code == ExitCode::interrupted ? "interrupted"
                                                                      : "failed";
    const std::chrono::duration<double> wall = transport::Clock::now() - started_;
    return summary({.status = status,
                    .reason = ending.reason,
                    .exit_code = static_cast<int>(ending.code),
                    .scene = how_.preparation.scene,
                    .groups = groups_,
                    .plan = plan_,
                    .findings = recorder_ ? recorder_->findings() : Findings{},
                    .impactor = hub_.impactor().ready,
                    .structure = hub_.structure().ready,
                    .impactor_timing = hub_.impactor().timing,
                    .structure_timing = hub_.structure().timing,
                    .wall_seconds = wall.count(),
                    .orchestrator_seconds = processor_seconds() - processor_at_start_});
  }

 private:
  // A peer that is lost after we stood still was not at fault: silence is what both sides saw.
  [[nodiscard]] std::string own_part() const {
    const double seconds = hub_.standstill().count();
    if (seconds <= 0.0) return "";
    char text[160];
    std::snprintf(text, sizeof text,
                  " (the orchestrator itself stood still for %.1f s just before: it was stopped, or the machine was)",
                  seconds);
    return text;
  }

  Ending abandon(const Ending& ending, const std::string& lost = "") {
    session_.abandon(ending.reason, lost);
    return keep(ending);
  }

  // What was computed is kept, whatever the end; a first failure's reason is not hidden by that of writing.
  Ending keep(Ending ending) {
    background_.reset();
    if (progress_) {
      progress_->finish();
    }
    try {
      if (file_) {
        add_backends();
        file_->flush();
      }
    } catch (const OutputError& error) {
      if (ending.code == ExitCode::done) {
        ending = {ExitCode::output, error.what()};
      }
    }
    return ending;
  }

  void add_backends() {
    for (const auto& [side, peer] : {std::pair{"impactor", &hub_.impactor()}, {"structure", &hub_.structure()}}) {
      file_->add(results::Array{.dataset = std::string("/timings/total/") + side,
                                .meaning = {"s", "wall clock: computing " + peer->hello.backend() + ", waiting"},
                                .values = {peer->timing.compute(), peer->timing.wait()},
                                .indices = {}});
    }
  }

  Hub& hub_;
  const Conduct& how_;
  Session session_;
  transport::Clock::time_point started_ = transport::Clock::now();
  double processor_at_start_ = processor_seconds();
  scene::Groups groups_ = how_.preparation.groups;  // of an external impactor's own mass, once it is known
  std::optional<StepPlan> plan_;
  std::optional<results::ResultsFile> file_;
  std::optional<Progress> progress_;
  std::optional<Recorder> recorder_;
  std::optional<BackgroundObserver> background_;  // works with all of the above: ends first
};

}  // namespace

Ending conduct(Hub& hub, const Conduct& how) {
  Run run(hub, how);
  Ending ending = run.end();
  const nlohmann::ordered_json summary = run.summary_of(ending);
  try {
    results::write_atomically(how.directory.summary(), summary.dump(2) + "\n");
  } catch (const OutputError& error) {
    if (ending.code == ExitCode::done) {
      ending = {ExitCode::output, error.what()};
    }
  }
  if (how.progress != Progress::Style::quiet) {
    std::fputs(digest(summary).c_str(), stdout);
    std::fflush(stdout);
  }
  return ending;
}

}  // namespace grainstep::orchestrator
