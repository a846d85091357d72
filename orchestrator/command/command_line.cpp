#include "orchestrator/command/command_line.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "declare/suggest.hpp"
#include "orchestrator/record/build_info.hpp"
#include "participant/seconds_to_wait.hpp"

namespace grainstep::orchestrator {
namespace {

void add_scene(CLI::App& command, SceneOptions& options) {
  command.add_option("scene", options.scene, "Scene file (docs/user/scene-reference.md)")->required();
  command.add_option("--set", options.set, "PATH=VALUE: overrides a key, e.g. impactor.slug.speed='300 m/s'")
      ->allow_extra_args(false);
}

/// What of a scene is executed only on the user's own word.
template <typename Options>
void add_allowances(CLI::App& command, Options& options) {
  command.add_flag("--allow-program", options.allow_program,
                   "Let the scene start a program that is not Grainstep's own");
  command.add_flag("--allow-deck", options.allow_deck,
                   "Let the scene run a LAMMPS script, which can do anything on this machine");
}

/// What `run` and `resume` have in common.
void add_run_options(CLI::App* run, RunOptions& options) {
  run->add_option("--ranks", options.ranks, "MPI ranks of the impactor")->check(CLI::Range(1, 4096));
  run->add_option("--threads", options.threads,
                  "Threads of both participants together, where they can use them (default: one per core)")
      ->check(CLI::Range(1, 4096));
  run->add_option("--checkpoint-every", options.checkpoint_every_s,
                  "Seconds between two checkpoints, from which grainstep resume goes on; 0: only when the run is ended "
                  "by Ctrl-C or SIGTERM")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  run->add_option("--retry", options.retry,
                  "How often a run that has lost a participant goes on by itself, from its latest checkpoint")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  run->add_flag("--quiet", options.quiet, "No progress, no summary on the terminal");
  run->add_option("--connect-deadline", options.deadlines.connect_s, "Seconds until both participants must be there")
      ->check(participant::seconds_to_wait());
  run->add_option("--step-deadline", options.deadlines.step_s, "Seconds of silence after which a participant is lost")
      ->check(participant::seconds_to_wait());
  run->add_option("--external", options.external, "A participant that somebody else starts: impactor or structure")
      ->check(CLI::IsMember({"impactor", "structure"}))
      ->allow_extra_args(false);
  run->add_option(
         "--path", options.path,
         "Way of forces and motion: hub (through the orchestrator), shared (memory of this host), direct (a connection "
         "between the participants), or auto: the shortest that both can take")
      ->check(CLI::IsMember({"auto", "hub", "shared", "direct"}));
  run->add_option("--listen", options.listen,
                  "tcp://HOST:PORT for external participants; the structure's port is the next one");
  run->add_option("--curve-dir", options.curve_dir, "Directory with the keys that encrypt tcp");
  run->add_flag("--allow-plain-tcp", options.allow_plain_tcp, "Let tcp leave this host without encryption");
  add_allowances(*run, options);
}

CLI::App* add_run(CLI::App& app, RunOptions& options) {
  CLI::App* run = app.add_subcommand("run", "Compute a scene");
  add_scene(*run, options.scene);
  run->add_option("--out", options.out, "Directory of the results (default: runs/<name of the scene>)");
  run->add_flag("--force", options.force, "Replace the run that is in the directory");
  add_run_options(run, options);
  return run;
}

CLI::App* add_resume(CLI::App& app, RunOptions& options) {
  CLI::App* resume = app.add_subcommand("resume", "Go on with a run from its latest checkpoint, bit for bit");
  resume->add_option("directory", options.out, "Directory of the run")->required();
  resume->add_option("--from", options.from, "Window of another checkpoint (grainstep show lists them)");
  resume->add_flag("--inexact", options.inexact,
                   "Go on with another build, instruction set or number of ranks, too: not bit for bit");
  add_run_options(resume, options);
  return resume;
}

CLI::App* add_check(CLI::App& app, CheckOptions& options) {
  CLI::App* check = app.add_subcommand("check", "Validate a scene and say what it would cost");
  add_scene(*check, options.scene);
  check->add_option("--ranks", options.ranks, "MPI ranks of the impactor, to say its cost for")
      ->check(CLI::Range(1, 4096));
  add_allowances(*check, options);
  return check;
}

CLI::App* add_study(CLI::App& app, StudyOptions& options) {
  CLI::App* study = app.add_subcommand("study", "Compute a set of scenes: table, plots; resumes where it stopped");
  study->add_option("study", options.study, "Study file (docs/user/study-reference.md)")->required();
  study->add_option("--out", options.out, "Directory of the results (default: runs/studies/<name of the study>)");
  study->add_option("--jobs", options.jobs, "Runs at a time (default: one per core)")->check(CLI::Range(1, 4096));
  study->add_option("--ranks", options.ranks, "MPI ranks of every impactor")->check(CLI::Range(1, 4096));
  study->add_flag("--long", options.include_long, "Points that are marked long, too");
  study->add_flag("--full", options.full, "With the study's `full` overrides: the same at the source's own resolution");
  study->add_option("--reuse", options.reuse, "Directory with runs of other studies, whose results are taken")
      ->allow_extra_args(false);
  study->add_flag("--repeat", options.repeat, "Compute again what is done, e.g. for quiet timings (with --jobs 1)");
  study->add_flag("--retry", options.retry, "Compute again what failed numerically");
  study->add_option("--page", options.page, "Write a page in Markdown, with the pictures in images/ beside it");
  study->add_flag("--list", options.list, "Say what there is to do, and do nothing");
  study->add_flag("--quiet", options.quiet, "Nothing on the terminal but errors");
  add_allowances(*study, options);
  return study;
}

CLI::App* add_conformance(CLI::App& app, ConformanceOptions& options) {
  CLI::App* conformance = app.add_subcommand(
      "conformance", "Try whether a participant keeps the protocol: grainstep conformance --role structure -- COMMAND");
  conformance->add_option("--role", options.role, "Which side it is: structure or impactor")
      ->required()
      ->check(CLI::IsMember({"structure", "impactor"}));
  conformance->add_option("--scene", options.scene.scene,
                          "Scene whose part it is told (default: one of the type external, without settings)");
  conformance->add_option("--set", options.scene.set, "PATH=VALUE: overrides a key of the scene")
      ->allow_extra_args(false);
  conformance->add_option("--only", options.only, "A clause by its name; may be repeated")->allow_extra_args(false);
  conformance->add_option("--patience", options.patience_s, "Seconds that any one answer may take")
      ->check(participant::seconds_to_wait());
  conformance->add_option("command", options.command, "The participant's command; --connect ENDPOINT is added to it");
  return conformance;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// CLI11 only says that a command is required, and that something was not expected.
std::string explain(const CLI::App& app, const std::string& first) {
  const auto commands = commands_of(app);
  const std::string known = declare::join_words(commands);
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    if (first.empty()) return "a command is missing; one of " + known;
    if (first.ends_with(".yaml")) return "a command is missing before '" + first + "'; one of " + known;
    if (first.starts_with('-')) return "unknown option '" + first + "'; a command comes first: " + known;
    const std::string near = declare::hint(first, commands);
    return "unknown command '" + first + "'" + near + (near.empty() ? "; commands: " : " Commands: ") + known;
  }
  const CLI::App& command = *chosen.front();
  if (const auto before = app.remaining(); !before.empty()) {
    return "'" + before.front() + "' stands before the command '" + command.get_name() + "'; it belongs behind it";
  }
  const auto left = command.remaining();
  if (left.empty()) return {};
  const std::string& word = left.front();
  if (!word.starts_with('-')) {
    return "'" + word +
           "' is one word too many: a value stands behind its option, and an option that may be repeated is "
           "written before each value";
  }
  return "unknown option '" + word + "'" + declare::hint(word.substr(0, word.find('=')), options_of(command));
}

int refuse(const CLI::App& app, const CLI::ParseError& error, const std::string& first) {
  const auto chosen = app.get_subcommands();
  const std::string program = "grainstep" + (chosen.empty() ? "" : " " + chosen.front()->get_name());
  const std::string better = explain(app, first);
  std::fprintf(stderr, "%s: %s\n%s --help tells what there is\n", program.c_str(),
               better.empty() ? error.what() : better.c_str(), program.c_str());
  return static_cast<int>(ExitCode::bad_input);
}

}  // namespace

CommandLine parse(int argc, const char* const* argv) {
  CLI::App app{"Granular flow meets structure: DEM and FE in lock step", "grainstep"};
  app.require_subcommand(1);
  app.set_version_flag("--version", build_info().version);
  RunOptions run_options;
  CheckOptions check_options;
  ShowOptions show_options;
  RunOptions resume_options;
  resume_options.resume = true;
  const CLI::App* run = add_run(app, run_options);
  const CLI::App* resume = add_resume(app, resume_options);
  const CLI::App* check = add_check(app, check_options);
  CLI::App* show = app.add_subcommand("show", "What a finished or running run says");
  show->add_option("directory", show_options.directory, "Directory of a run")->required();
  show->add_flag("--json", show_options.json, "summary.json, or progress, as JSON");

  StudyOptions study_options;
  const CLI::App* study = add_study(app, study_options);

  ConformanceOptions conformance_options;
  const CLI::App* conformance = add_conformance(app, conformance_options);

  CommandLine out;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool answered = error.get_exit_code() == 0;  // --help, --version
    out.exit_code = answered ? app.exit(error) : refuse(app, error, argc > 1 ? argv[1] : "");
    return out;
  }
  if (run->parsed()) {
    out.run = run_options;
  } else if (resume->parsed()) {
    out.run = resume_options;
  } else if (check->parsed()) {
    out.check = check_options;
  } else if (study->parsed()) {
    out.study = study_options;
  } else if (conformance->parsed()) {
    out.conformance = conformance_options;
  } else {
    out.show = show_options;
  }
  return out;
}

}  // namespace grainstep::orchestrator
