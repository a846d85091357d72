#include "orchestrator/command/check_command.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "orchestrator/command/fidelity.hpp"
#include "orchestrator/command/memory.hpp"
#include "orchestrator/command/preparation.hpp"
#include "orchestrator/record/progress.hpp"

namespace grainstep::orchestrator {
namespace {

constexpr double mebibyte = 1024.0 * 1024.0;

// A group that the scene has not is a dash.
std::string group(double value) { return figure(value, 4); }

void print_groups(const scene::Groups& g) {
  std::printf("impulse number I_o       %s\n", group(g.impulse_number).c_str());
  std::printf("areal mass ratio m_bar   %s\n", group(g.areal_mass_ratio).c_str());
  std::printf("loading time ratio tau   %s\n", group(g.loading_time_ratio).c_str());
  std::printf("width ratio a/L          %s\n", group(g.width_ratio).c_str());
  std::printf("end                      %.4g s, t_bar %s, t_hat %s\n", g.end, group(g.end / g.reference_time).c_str(),
              group(g.end / g.slug_time).c_str());
}

void print_plan(const StepPlan& plan) {
  std::printf("steps                    impactor %.4g s, structure %.4g s; %u and %u per window of %.4g s\n",
              plan.impactor_step, plan.structure_step, plan.impactor_steps, plan.structure_steps, plan.window);
  std::printf("windows                  %llu\n", static_cast<unsigned long long>(plan.windows));
}

void print_side(const std::optional<wire::Ready>& side, const char* name) {
  if (!side) std::printf("%-24s external: it will say itself what it is\n", name);
  if (!side) return;
  for (const wire::Fact& fact : side->fact()) std::printf("%-24s %s\n", fact.name().c_str(), fact.text().c_str());
}

// Ranks share particles evenly where the slug is tall; what they lose to each other is measured in bench/README.md.
void print_cost(const Preparation& p, int ranks) {
  const std::optional<Cost> cost = cost_of(p);
  if (!cost) {
    return;
  }
  const double memory =
      (static_cast<double>(p.impactor->memory()) + (ranks - 1) * static_cast<double>(p.impactor->rank_memory())) /
      mebibyte;
  std::printf("memory                   %.0f MiB impactor", memory);
  if (ranks > 1) std::printf(" (%.0f MiB each of %d ranks)", memory / ranks, ranks);
  std::printf(", %.0f MiB structure\n", static_cast<double>(p.structure->memory()) / mebibyte);
  std::printf("estimated time           %s impactor%s, %s structure, at the same time on a core each\n",
              duration_text(cost->impactor / ranks).c_str(),
              ranks > 1 ? (" (" + std::to_string(ranks) + " ranks at their best)").c_str() : "",
              duration_text(cost->structure).c_str());
}

// For this scene: its size and duration may be other ones than the measured. Nothing where it cannot be computed here:
// too few particles for this slug, too coarse a mesh for this beam, a program that is not there.
std::optional<double> seconds_of(const scene::Scene& scene, const RunOptions& options) {
  try {
    const auto cost = cost_of(prepare(scene, options));
    return cost ? std::max(cost->impactor, cost->structure) : 0.0;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string about(double seconds) { return seconds < 1.0 ? "about a second" : "about " + duration_text(seconds); }

// The errors are those of the laws, the mesh and the sizes: of either engine.
std::string time_text(const scene::Scene& scene, const RunOptions& options) {
  const std::optional<double> seconds = seconds_of(scene, options);
  if (!seconds) return "not possible here";
  const bool other = scene.impactor().engine() == scene::Impactor::ENGINE_LAMMPS && options.ranks == 1;
  if (!other || *seconds < 1.0) return about(*seconds);
  scene::Scene native = scene;
  native.mutable_impactor()->set_engine(scene::Impactor::ENGINE_NATIVE);
  const std::optional<double> sooner = seconds_of(native, options);
  return about(*seconds) + (sooner ? ", with impactor.engine: native " + duration_text(*sooner) : "");
}

void print_recommendation(double percent, const scene::Scene& scene, const RunOptions& options) {
  const Fidelity* one = cheapest_within(percent, measured_fidelities());
  if (one == nullptr) {
    return;
  }
  const scene::Scene better = at_fidelity(scene, *one);
  std::printf("for errors below %3.2g%%    D = %.3g mm, mesh h/%g (a/D = %g, measured %.2g%%): %s\n", percent,
              1e3 * better.impactor().slug().particle().diameter(), one->refinement, one->particles_across,
              one->error_deflection, time_text(better, options).c_str());
}

void print_fidelity(const scene::Scene& scene, const RunOptions& options) {
  if (!is_like_the_measured(scene)) {
    const bool plate = scene.symmetry() == scene::SYMMETRY_AXISYMMETRIC;
    std::printf(
        "expected error           not measured for this kind of scene (%s)\n",
        plate ? "docs/accuracy-plates.md has the monolithic plate" : "docs/accuracy.md has the monolithic beam");
    return;
  }
  const Fidelity* one = fidelity_of(scene, measured_fidelities());
  if (one == nullptr) {
    std::printf("expected error           larger than measured: coarser than every setting of docs/accuracy.md\n");
  } else if (one->error_deflection == 0.0) {
    std::printf("expected error           as fine as the run that errors were measured against, or finer\n");
  } else {
    std::printf(
        "expected error           %.2g%% of the deflection, %.2g%% of the impulse, %.2g%% of the early pressure (%s)\n",
        one->error_deflection, one->error_impulse, one->error_pressure, one->name.c_str());
  }
  for (const double percent : {2.0, 1.0, 0.5}) {
    print_recommendation(percent, scene, options);
  }
}

}  // namespace

void check(const CheckOptions& options) {
  RunOptions run;
  run.scene = options.scene;
  run.ranks = options.ranks;
  run.allow_program = options.allow_program;
  run.allow_deck = options.allow_deck;
  run.deadlines = options.deadlines;
  const Preparation p = prepare(run);
  print_warnings(p);
  std::printf("%s\n", p.scene.title().empty() ? options.scene.scene.c_str() : p.scene.title().c_str());
  print_groups(p.groups);
  print_side(p.impactor, "impactor");
  print_side(p.structure, "structure");
  if (p.plan) {
    print_plan(*p.plan);
  }
  print_cost(p, options.ranks);
  require_memory(p, options.ranks, memory_of_machine());
  print_fidelity(p.scene, run);
}

}  // namespace grainstep::orchestrator
