#include "orchestrator/command/preparation.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "base/team.hpp"
#include "declare/write.hpp"
#include "orchestrator/process/asking.hpp"
#include "orchestrator/process/participants.hpp"
#include "scene/load.hpp"

namespace grainstep::orchestrator {

Preparation prepare(const RunOptions& options) {
  return prepare(scene::load_scene(options.scene.scene, options.scene.set), options);
}

Preparation prepare(scene::Scene loaded, const RunOptions& options) {
  Preparation out = prepare_unasked(std::move(loaded), options);
  ask_participants(out, options);
  return out;
}

Preparation prepare_unasked(scene::Scene loaded, const RunOptions& options) {
  Preparation out;
  out.scene = std::move(loaded);
  if (options.ranks > 1 && !scene::program_of(out.scene, wire::IMPACTOR).ranks) {
    throw InputError("--ranks " + std::to_string(options.ranks) +
                     ": this impactor is one process, without MPI ranks; leave --ranks out");
  }
  check_programs(out.scene, options);
  check_deck(out.scene, options);
  check_connection(out.scene, options);
  out.hash = scene::scene_hash(out.scene);
  out.yaml = declare::to_yaml(out.scene);
  for (scene::Finding& finding : scene::check_rules(out.scene)) {
    if (finding.severity == scene::Severity::warning) out.warnings.push_back(std::move(finding));
  }
  out.groups = scene::groups(out.scene);
  return out;
}

void ask_participants(Preparation& p, const RunOptions& options) {
  Answers answers = ask(p.scene, p.hash, options);
  p.impactor = std::move(answers.impactor);
  p.structure = std::move(answers.structure);
  if (p.impactor && is_of_particles(*p.impactor)) p.groups = scene::groups(p.scene, p.impactor->mass());
  if (p.impactor && p.structure) {
    p.plan = plan_steps(p.scene, p.groups.end, steps_of(*p.impactor), steps_of(*p.structure));
  }
  if (const auto cost = cost_of(p)) {
    p.threads =
        share_threads(options.threads > 0 ? options.threads : base::usable_cores(), *cost, answers.takes_threads);
  }
}

bool is_of_particles(const wire::Ready& ready) {
  return ready.counted() == "particles" && ready.size() > 0 && ready.mass() > 0.0;
}

void print_warnings(const Preparation& preparation, const std::string& of) {
  for (const scene::Finding& warning : preparation.warnings) {
    std::fprintf(stderr, "grainstep: warning: %s%s: %s\n", of.c_str(), warning.path.c_str(), warning.text.c_str());
  }
  for (const auto* side : {&preparation.structure, &preparation.impactor}) {
    if (!*side) continue;
    for (const std::string& warning : (*side)->warning()) {
      std::fprintf(stderr, "grainstep: warning: %s%s\n", of.c_str(), warning.c_str());
    }
  }
  if (preparation.plan) print_warnings(*preparation.plan, of);
}

void print_warnings(const StepPlan& plan, const std::string& of) {
  for (const std::string& warning : plan.warnings) {
    std::fprintf(stderr, "grainstep: warning: %s%s\n", of.c_str(), warning.c_str());
  }
}

std::optional<Cost> cost_of(const Preparation& p) {
  if (!p.plan) {
    return std::nullopt;
  }
  const auto windows = static_cast<double>(p.plan->windows);
  return Cost{.impactor = windows * p.plan->impactor_steps * p.impactor->seconds_per_step(),
              .structure = windows * p.plan->structure_steps * p.structure->seconds_per_step()};
}

}  // namespace grainstep::orchestrator
