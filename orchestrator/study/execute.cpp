#include "orchestrator/study/execute.hpp"

#include <algorithm>
#include <list>
#include <map>
#include <memory>
#include <numeric>

#include "base/error.hpp"
#include "orchestrator/command/ending.hpp"
#include "orchestrator/process/interrupted.hpp"
#include "orchestrator/record/run_facts.hpp"
#include "orchestrator/session/event_loop.hpp"
#include "orchestrator/study/study_progress.hpp"
#include "process/child_process.hpp"
#include "process/interrupt.hpp"
#include "process/launch.hpp"
#include "results/atomic_file.hpp"
#include "results/run_directory.hpp"

namespace grainstep::study {
namespace {

namespace fs = std::filesystem;
using orchestrator::Interrupted;
using transport::Clock;

constexpr auto longest_wait = std::chrono::milliseconds(500);
constexpr auto look_interval = std::chrono::seconds(2);
// A run that is asked to end tells its participants, waits for what they still have to say and writes a summary.
constexpr std::chrono::milliseconds grace{20'000};
constexpr std::size_t tail_lines = 5;

double seconds_since(Clock::time_point when) { return std::chrono::duration<double>(Clock::now() - when).count(); }

struct Active {
  std::size_t point = 0;
  fs::path log;
  std::unique_ptr<process::ChildProcess> process;
  bool ended = false;
  double fraction = 0.0;
  Clock::time_point started = Clock::now();
  Clock::time_point looked = Clock::now();
};

/// How far a run is, by its files. A moment when they cannot be read leaves the last answer.
void look_at(Active& run, const fs::path& directory) {
  const results::RunDirectory files(directory);
  std::error_code ignored;
  if (Clock::now() - run.looked < look_interval || !fs::exists(files.results(), ignored)) return;
  run.looked = Clock::now();
  try {
    run.fraction = std::clamp(orchestrator::read_progress(files)["progress"].get<double>(), run.fraction, 1.0);
  } catch (const InputError&) {
  }
}

class Executor {
 public:
  Executor(const Plan& plan, const Execution& how, std::vector<Outcome>& outcomes)
      : plan_(plan), how_(how), outcomes_(outcomes), queue_(open_points()), progress_(how.progress, queue_.size()) {
    loop_.add(interrupt_.descriptor(), [this] {
      if (interrupt_.raised()) throw Interrupted();
    });
  }

  bool run() {
    try {
      while (!queue_.empty() || !active_.empty()) {
        while (!queue_.empty() && active_.size() < static_cast<std::size_t>(how_.jobs)) start();
        loop_.wait(Clock::now() + longest_wait);
        settle();
        show();
      }
    } catch (const Interrupted&) {
      end_all();
      progress_.finish();
      return false;
    } catch (...) {  // nobody foresaw it: the runs end in the same order, and their tables are written
      end_all();
      progress_.finish();
      throw;
    }
    share();
    progress_.finish();
    return true;
  }

 private:
  /// One point per scene, the most expensive first.
  std::vector<std::size_t> open_points() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < plan_.points.size(); ++i) {
      if (outcomes_[i].state == Outcome::State::open && first_of_.emplace(plan_.points[i].key, i).second)
        open.push_back(i);
    }
    std::stable_sort(open.begin(), open.end(), [this](std::size_t a, std::size_t b) {
      return plan_.points[a].estimate > plan_.points[b].estimate;
    });
    return open;
  }

  void start() {
    Active& run = active_.emplace_back();
    run.point = queue_.front();
    queue_.erase(queue_.begin());
    try {
      launch(run);
    } catch (...) {  // the directory cannot be made, the program is not there, the system gives no process
      const orchestrator::Ending ending = orchestrator::ending_of_current_exception();
      fail(run.point, static_cast<int>(ending.code), ending.reason);
      active_.pop_back();
      ++done_;
    }
  }

  void launch(Active& run) {
    const PlannedPoint& point = plan_.points[run.point];
    const fs::path& directory = outcomes_[run.point].directory;
    run.log = directory / "logs" / "study.log";
    std::error_code error;
    fs::create_directories(run.log.parent_path(), error);
    fs::remove(run.log, error);
    const fs::path scene = directory / "scene.yaml";
    results::write_atomically(
        scene, "# Point '" + point.id + "' of " + plan_.file.filename().string() + "\n" + point.preparation.yaml);
    std::vector<std::string> arguments = {"run",       scene.string(),
                                          "--out",     directory.string(),
                                          "--force",   "--quiet",
                                          "--ranks",   std::to_string(how_.ranks),
                                          "--threads", "1"};
    if (how_.allow_program) arguments.emplace_back("--allow-program");
    if (how_.allow_deck) arguments.emplace_back("--allow-deck");
    run.process = std::make_unique<process::ChildProcess>(
        point.id,
        process::Command{
            .program = process::find_program("grainstep"), .arguments = std::move(arguments), .environment = {}},
        run.log);
    const int descriptor = run.process->descriptor();
    loop_.add(descriptor, [this, &run, descriptor] {
      run.ended = true;
      loop_.remove(descriptor);
    });
  }

  void settle() {
    for (auto run = active_.begin(); run != active_.end();) {
      if (!run->ended) {
        ++run;
        continue;
      }
      static_cast<void>(run->process->wait(std::chrono::milliseconds(0)));
      finish(*run);
      work_done_ += plan_.points[run->point].estimate;
      ++done_;
      run = active_.erase(run);
    }
  }

  void finish(const Active& run) {
    const PlannedPoint& point = plan_.points[run.point];
    Outcome& outcome = outcomes_[run.point];
    Outcome found = look(outcome.directory, point.key);
    const int code = run.process->exit_code().value_or(static_cast<int>(ExitCode::unforeseen));
    if (found.state == Outcome::State::done && code == 0) {
      outcome = std::move(found);
      outcome.computed = true;
      progress_.say("done    " + point.id + "  (" + orchestrator::duration_text(seconds_since(run.started)) + ")");
    } else {
      const std::string tail = run.process->log_tail(tail_lines);
      fail(run.point, code == 0 ? static_cast<int>(ExitCode::unforeseen) : code,
           !found.reason.empty() ? found.reason
           : !tail.empty()       ? tail
                                 : run.process->describe_end());
    }
  }

  void fail(std::size_t point, int code, const std::string& reason) {
    Outcome& outcome = outcomes_[point];
    outcome.state = Outcome::State::failed;
    outcome.exit_code = code;
    outcome.reason = reason;
    outcome.computed = true;
    progress_.say("FAILED  " + plan_.points[point].id + "  (exit code " + std::to_string(code) + "): " + reason);
  }

  void show() {
    if (!progress_.due()) return;
    std::vector<Remaining::Active> active;
    std::vector<std::string> names;
    double open = 0.0;
    double done = work_done_;
    for (Active& run : active_) {
      look_at(run, outcomes_[run.point].directory);
      const PlannedPoint& point = plan_.points[run.point];
      active.push_back({.estimate = point.estimate, .fraction = run.fraction, .elapsed = seconds_since(run.started)});
      names.push_back(point.id + " " + std::to_string(static_cast<int>(100.0 * run.fraction)) + "%");
      done += run.fraction * point.estimate;
      open += (1.0 - run.fraction) * point.estimate;
    }
    const double waiting = std::accumulate(queue_.begin(), queue_.end(), 0.0, [this](double sum, std::size_t point) {
      return sum + plan_.points[point].estimate;
    });
    const double all = done + open + waiting;
    progress_.draw(done_, names, all > 0.0 ? done / all : 0.0,
                   Remaining::seconds(seconds_since(started_), work_done_, waiting, active));
  }

  /// A run may have been done just before it was asked to end.
  void keep_if_done(const Active& run) {
    Outcome found = look(outcomes_[run.point].directory, plan_.points[run.point].key);
    if (found.state != Outcome::State::done) return;
    outcomes_[run.point] = std::move(found);
    outcomes_[run.point].computed = true;
  }

  void end_all() {
    for (const Active& run : active_) run.process->ask_to_end();
    const auto deadline = Clock::now() + grace;
    for (Active& run : active_) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
      loop_.remove(run.process->descriptor());
      run.process->terminate(std::max(left, std::chrono::milliseconds(1)));
      keep_if_done(run);
    }
  }

  /// Points of equal scenes have one run.
  void share() {
    for (std::size_t i = 0; i < plan_.points.size(); ++i) {
      const auto first = first_of_.find(plan_.points[i].key);
      const bool waits = outcomes_[i].state == Outcome::State::open || outcomes_[i].state == Outcome::State::postponed;
      if (waits && first != first_of_.end()) outcomes_[i] = outcomes_[first->second];
    }
  }

  const Plan& plan_;
  Execution how_;
  std::vector<Outcome>& outcomes_;
  process::Interrupt interrupt_;  // before the first thread
  orchestrator::EventLoop loop_;
  std::map<std::string, std::size_t> first_of_;
  std::vector<std::size_t> queue_;
  StudyProgress progress_;
  std::list<Active> active_;
  std::size_t done_ = 0;
  double work_done_ = 0.0;
  Clock::time_point started_ = Clock::now();
};

}  // namespace

bool execute(const Plan& plan, const Execution& how, std::vector<Outcome>& outcomes) {
  return Executor(plan, how, outcomes).run();
}

}  // namespace grainstep::study
