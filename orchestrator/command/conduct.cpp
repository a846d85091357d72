#include "orchestrator/command/conduct.hpp"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/processor_time.hpp"
#include "orchestrator/process/participants.hpp"
#include "orchestrator/record/background_observer.hpp"
#include "orchestrator/record/build_info.hpp"
#include "orchestrator/record/recorder.hpp"
#include "orchestrator/record/summary.hpp"
#include "orchestrator/record/surface_record.hpp"
#include "orchestrator/session/session.hpp"
#include "results/atomic_file.hpp"
#include "results/checkpoints.hpp"

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

std::string status_of(const Ending& ending) {
  if (ending.code == ExitCode::done) return "done";
  return ending.code == ExitCode::interrupted ? "interrupted" : "failed";
}

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// A reason may quote a participant's log, which holds whatever bytes it was written. Messages and JSON take UTF-8 only.
std::string as_utf8(const std::string& text) { return Json::parse(dumped(text, -1)).get<std::string>(); }

void write(const Json& summary, const results::RunDirectory& directory) {
  results::write_atomically(directory.summary(), dumped(summary, 2) + "\n");
}

/// The parts of a run that its end needs to know.
class Run {
 public:
  Run(Hub& hub, const Conduct& how)
      : hub_(hub),
        how_(how),
        session_(hub,
                 {.scene = how.preparation.scene,
                  .hash = how.preparation.hash,
                  .end = how.preparation.groups.end,
                  .path = how.path,
                  .one_host = how.one_host,
                  .resume = how.resume != nullptr ? &how.resume->checkpoint : nullptr,
                  .save_when = save_when(how)},
                 how.deadlines) {}

  void go() {
    const Preparation& p = how_.preparation;
    begin_file();
    session_.introduce();
    plan_ = session_.prepare();
    if (how_.resume != nullptr) require_same(*how_.resume, about(), how_.inexact);
    if (!p.plan) print_warnings(*plan_);  // an external side has told its steps only now
    const wire::Ready& impactor = hub_.impactor().ready;
    const wire::Ready& structure = hub_.structure().ready;
    if (is_of_particles(impactor)) groups_ = scene::groups(p.scene, impactor.mass());
    progress_.emplace(stdout, how_.progress, Progress::Scale{plan_->windows, plan_->window, groups_.reference_time});
    begin_record();
    recorder_.emplace(Recorder::Context{.scene = p.scene,
                                        .groups = groups_,
                                        .plan = *plan_,
                                        .surface = structure.surface(),
                                        .masses = {impactor.mass(), structure.mass()},
                                        .levels = {impactor.ledger(), structure.ledger()},
                                        .keep = keeper(),
                                        .record = record_ ? &*record_ : nullptr},
                      how_.directory, *file_, [this](std::uint64_t window) { progress_->tick(window); });
    if (how_.resume != nullptr) restore_recorder();
    schedule_checkpoints();
    background_.emplace(*recorder_);
    session_.run(*plan_, *background_);
  }

  /// Runs go() and turns whatever ends it into an Ending; the other side is told.
  Ending end() {
    try {
      go();
      return keep({});
    } catch (...) {
      return abandon(ending_of_current_exception());
    }
  }

  [[nodiscard]] Json summary_of(const Ending& ending) const {
    const std::chrono::duration<double> wall = transport::Clock::now() - started_;
    return summary({.status = status_of(ending),
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
                    .threads = how_.preparation.threads,
                    .path = text_of(session_.path()),
                    .wall_seconds = wall.count(),
                    .orchestrator_seconds = processor_seconds() - processor_at_start_});
  }

 private:
  static std::function<bool(std::uint64_t)> save_when(const Conduct& how) {
    if (how.schedule == nullptr) return {};
    return [schedule = how.schedule](std::uint64_t window) { return schedule->due(window); };
  }

  void schedule_checkpoints() {
    const std::uint32_t wanted = how_.preparation.scene.output().checkpoints();
    if (wanted == 0 || how_.schedule == nullptr) return;
    if (!Saving(hub_).possible()) {
      std::fprintf(stderr,
                   "grainstep: warning: output.checkpoints: there will be none: one of the sides cannot save\n");
      return;
    }
    const std::uint64_t done = how_.resume != nullptr ? how_.resume->checkpoint.window : 0;
    how_.schedule->spread(wanted, plan_->windows, done);
  }

  [[nodiscard]] About about() const {
    return {.scene_hash = how_.preparation.hash,
            .plan = *plan_,
            .impactor = hub_.impactor().hello.backend(),
            .structure = hub_.structure().hello.backend(),
            .ranks = how_.ranks};
  }

  void begin_file() {
    const Preparation& p = how_.preparation;
    if (how_.resume != nullptr) {
      std::error_code none;
      std::filesystem::remove(how_.directory.summary(), none);  // of the run that was ended: this one has none yet
      file_.emplace(results::ResultsFile::GoOn{}, how_.directory.results(), how_.resume->contents);
      return;
    }
    results::write_atomically(how_.directory.scene(), p.yaml);
    file_.emplace(how_.directory.results(), texts(p));
    file_->add(results::Array{
        .dataset = "/scene/end", .meaning = {"s", "when the run is to end"}, .values = {p.groups.end}, .indices = {}});
  }

  void begin_record() {
    if (!how_.preparation.scene.output().record()) return;
    record::About about = about_record(how_.preparation.scene, how_.preparation.hash, plan_->window);
    *about.mutable_impactor() = hub_.impactor().ready;
    *about.mutable_structure() = hub_.structure().ready;
    if (how_.resume != nullptr) {
      record_.emplace(how_.directory.record(), about, how_.resume->checkpoint.window);
    } else {
      record_.emplace(how_.directory.record(), about);
    }
  }

  /// Called in the recorder's thread.
  std::function<void(Checkpoint, std::string)> keeper() {
    if (how_.schedule == nullptr) return {};
    return [this, about = text_of(about())](Checkpoint checkpoint, std::string recorder) {
      const std::uint64_t window = checkpoint.window;
      Resume resume{.checkpoint = std::move(checkpoint),
                    .contents = file_->contents(),
                    .recorder = std::move(recorder),
                    .about = about};
      results::Checkpoints(how_.directory.checkpoints()).write(window, parts_of(std::move(resume)));
      how_.schedule->written();
    };
  }

  void restore_recorder() {
    try {
      recorder_->restore(how_.resume->recorder);
    } catch (const std::range_error& error) {
      throw InputError(std::string("the checkpoint's part of the orchestrator is not of this run: ") + error.what());
    }
  }

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

  [[nodiscard]] std::string account_of(const std::string& peer) const {
    const std::string account = how_.account_of ? how_.account_of(peer) : "";
    return account.empty() ? "" : "; " + account;
  }

  Ending abandon(Ending ending) {
    try {
      if (!ending.lost.empty()) ending.reason += own_part() + account_of(ending.lost);
      ending.reason = as_utf8(ending.reason);
    } catch (...) {  // what is known already has to do
    }
    session_.abandon(ending.reason, ending.lost);
    return keep(std::move(ending));
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
    } catch (...) {
      if (ending.code == ExitCode::done) {
        ending = ending_of_current_exception();
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
  std::optional<SurfaceRecord> record_;
  std::optional<Progress> progress_;
  std::optional<Recorder> recorder_;
  std::optional<BackgroundObserver> background_;  // works with all of the above: ends first
};

}  // namespace

Ending conduct(Hub& hub, const Conduct& how) {
  Run run(hub, how);
  Ending ending = run.end();
  try {
    const Json summary = run.summary_of(ending);
    write(summary, how.directory);
    if (how.progress != Progress::Style::quiet) {
      std::fputs(digest(summary).c_str(), stdout);
      std::fflush(stdout);
    }
  } catch (...) {
    if (ending.code == ExitCode::done) {
      ending = ending_of_current_exception();
    }
  }
  return ending;
}

void write_summary_of(const Ending& ending, const Preparation& preparation, const results::RunDirectory& directory) {
  write(summary({.status = status_of(ending),
                 .reason = ending.reason,
                 .exit_code = static_cast<int>(ending.code),
                 .scene = preparation.scene,
                 .groups = preparation.groups,
                 .plan = std::nullopt,
                 .findings = {},
                 .impactor = {},
                 .structure = {},
                 .impactor_timing = {},
                 .structure_timing = {}}),
        directory);
}

}  // namespace grainstep::orchestrator
