#include "orchestrator/study/study_command.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <thread>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "orchestrator/study/execute.hpp"
#include "orchestrator/study/page.hpp"
#include "process/child_process.hpp"
#include "process/launch.hpp"
#include "results/directory_lock.hpp"

namespace grainstep::study {
namespace {

namespace fs = std::filesystem;
using orchestrator::StudyOptions;

fs::path root_of(const StudyOptions& options) {
  const std::string name = options.study.stem().string() + (options.full ? "-full" : "");
  return (options.out.empty() ? fs::path("runs") / "studies" / name : options.out).lexically_normal();
}

/// `repeat` opens what is done already; runs of other studies stay theirs.
void choose(const Plan& plan, const StudyOptions& options, const fs::path& root, std::vector<Outcome>& outcomes) {
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    Outcome& outcome = outcomes[i];
    const bool asked_for = options.include_long || !plan.points[i].is_long;
    const bool again = (options.repeat && asked_for) || (options.retry && outcome.state == Outcome::State::failed);
    if (again && outcome.state != Outcome::State::open) {
      const fs::path within = outcome.directory.lexically_relative(root);
      const bool own = !within.empty() && *within.begin() != "..";
      const fs::path directory = own ? outcome.directory : root / plan.points[i].directory;
      outcome = Outcome();
      outcome.directory = directory;
    }
    if (outcome.state == Outcome::State::open && !asked_for) outcome.state = Outcome::State::postponed;
  }
}

std::size_t count(const std::vector<Outcome>& outcomes, Outcome::State state) {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(), [state](const Outcome& o) { return o.state == state; }));
}

void list(const Plan& plan, const std::vector<Outcome>& outcomes) {
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    const PlannedPoint& point = plan.points[i];
    std::printf("%-8s %-50s %10s  %s\n", state_name(outcomes[i].state), point.id.c_str(),
                orchestrator::duration_text(point.estimate).c_str(), outcomes[i].directory.c_str());
  }
}

/// Pictures are an extra: without Python and matplotlib the numbers are there all the same.
void draw(const fs::path& root) {
  const fs::path log = root / "plot.log";
  std::error_code ignored;
  fs::remove(log, ignored);
  try {
    process::ChildProcess drawing(
        "grainstep-plot-study",
        {.program = process::find_program("grainstep-plot-study"), .arguments = {root.string()}, .environment = {}},
        log);
    if (!drawing.wait(std::chrono::minutes(5)) || drawing.exit_code() != 0) {
      std::fprintf(stderr, "grainstep: no pictures were drawn: grainstep-plot-study %s\n%s",
                   drawing.describe_end().c_str(), drawing.log_tail(5).c_str());
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "grainstep: no pictures were drawn: %s\n", error.what());
  }
}

void conclude(const Report& report, const fs::path& root) {
  const auto& outcomes = report.outcomes;
  const auto computed = std::count_if(outcomes.begin(), outcomes.end(),
                                      [](const Outcome& o) { return o.computed && o.state == Outcome::State::done; });
  std::printf("%zu points: %zu done (%td of them now), %zu failed, %zu long ones left for --long, %zu open -> %s\n",
              outcomes.size(), count(outcomes, Outcome::State::done), computed, count(outcomes, Outcome::State::failed),
              count(outcomes, Outcome::State::postponed), count(outcomes, Outcome::State::open), root.c_str());
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i].state == Outcome::State::failed && !outcomes[i].computed) {
      std::printf("failed   %s: %s\n", report.plan.points[i].id.c_str(), outcomes[i].reason.c_str());
    }
  }
  for (int i = 0; i < report.plan.study.findings_size(); ++i) {
    const Finding& finding = report.plan.study.findings(i);
    const Verdict& verdict = report.verdicts[static_cast<std::size_t>(i)];
    std::printf("%-8s %s: %s%s%s\n", state_name(verdict.state), finding.statement().c_str(),
                figure(verdict.value, 5).c_str(), verdict.wanted.empty() ? "" : ", stated ", verdict.wanted.c_str());
  }
  std::fflush(stdout);
}

int exit_code(const Report& report, bool whole) {
  if (!whole) return static_cast<int>(ExitCode::interrupted);
  for (const Outcome& outcome : report.outcomes) {
    if (outcome.state == Outcome::State::failed) return outcome.exit_code;
  }
  const bool fails = std::any_of(report.verdicts.begin(), report.verdicts.end(),
                                 [](const Verdict& v) { return v.state == Verdict::State::fails; });
  return static_cast<int>(fails ? ExitCode::numerical : ExitCode::done);
}

Execution execution_of(const StudyOptions& options) {
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  return {.jobs = options.jobs > 0 ? options.jobs : static_cast<int>(cores),
          .ranks = options.ranks,
          .allow_program = options.allow_program,
          .allow_deck = options.allow_deck,
          .progress = orchestrator::Progress::style_for(stdout, options.quiet)};
}

/// Tables, pictures, page and the lines on the terminal. Returns the exit code.
int report_on(const Plan& plan, const StudyOptions& options, const fs::path& root, const std::vector<Outcome>& outcomes,
              bool whole) {
  Numbers numbers(plan, outcomes);
  numbers.compute_columns();
  const std::vector<Verdict> verdicts = judge(plan, outcomes, numbers);
  const Report report{.plan = plan, .outcomes = outcomes, .numbers = numbers, .verdicts = verdicts};
  write_tables(report, root);
  if (plan.study.plots_size() + plan.study.snapshots_size() > 0 && whole) draw(root);
  if (!options.page.empty() && whole)
    write_page(report, root, options.page,
               "grainstep study " + options.study.string() + (options.full ? " --full" : ""));
  if (!options.quiet) conclude(report, root);
  return exit_code(report, whole);
}

}  // namespace

int study(const StudyOptions& options) {
  orchestrator::RunOptions of_runs;
  of_runs.allow_program = options.allow_program;
  of_runs.allow_deck = options.allow_deck;
  const Plan plan = load_plan(options.study, options.full ? Fidelity::full : Fidelity::recommended, of_runs);
  const fs::path root = root_of(options);
  for (const fs::path& other : options.reuse) {
    std::error_code ignored;
    if (!fs::is_directory(other, ignored)) throw InputError("--reuse " + other.string() + ": no such directory");
  }
  const auto look_around = [&] {
    std::vector<Outcome> outcomes = locate(plan, root, options.reuse);
    choose(plan, options, root, outcomes);
    return outcomes;
  };
  if (options.list) {
    list(plan, look_around());
    return 0;
  }
  std::error_code error;
  fs::create_directories(root, error);
  const results::DirectoryLock lock(root / "study.lock", "a study");
  std::vector<Outcome> outcomes = look_around();
  for (const PlannedPoint& point : plan.points) orchestrator::print_warnings(point.preparation, point.id + ": ");
  bool whole = false;
  std::exception_ptr unforeseen;
  try {
    whole = execute(plan, execution_of(options), outcomes);
  } catch (...) {  // the tables of what was computed are written first
    unforeseen = std::current_exception();
  }
  const int code = report_on(plan, options, root, outcomes, whole);
  if (unforeseen) std::rethrow_exception(unforeseen);
  return code;
}

}  // namespace grainstep::study
