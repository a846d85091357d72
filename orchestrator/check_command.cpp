#include "orchestrator/check_command.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "orchestrator/fidelity.hpp"
#include "orchestrator/memory.hpp"
#include "orchestrator/preparation.hpp"
#include "orchestrator/progress.hpp"

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

void print_sides(const Preparation& p) {
  if (p.impactor && p.impactor->elements > 0) {
    std::printf("foam elements            %llu, stable step %.4g s\n",
                static_cast<unsigned long long>(p.impactor->elements), p.impactor->stable_step);
  } else if (p.impactor && p.impactor->particles == 0) {
    std::printf("particles                0: a prescribed load, which has no step of its own\n");
  } else if (p.impactor) {
    std::printf("particles                %llu, stable step %.4g s, contact time %.4g s\n",
                static_cast<unsigned long long>(p.impactor->particles), p.impactor->stable_step,
                p.impactor->contact_time);
    if (p.impactor->largest > p.impactor->smallest) {
      std::printf("diameters                %.4g to %.4g mm\n", 1e3 * p.impactor->smallest, 1e3 * p.impactor->largest);
    }
  } else {
    std::printf("particles                known to the external impactor\n");
  }
  if (p.structure) {
    std::printf("elements                 %llu, stable step %.4g s, element size %.4g m\n",
                static_cast<unsigned long long>(p.structure->elements), p.structure->stable_step,
                p.structure->element_size);
  } else {
    std::printf("elements                 known to the external structure\n");
  }
}

// Ranks share particles evenly where the slug is tall; what they lose to each other is measured in bench/README.md.
void print_cost(const Preparation& p, int ranks) {
  const std::optional<Cost> cost = cost_of(p);
  if (!cost) {
    return;
  }
  const double memory =
      (static_cast<double>(p.impactor->memory_bytes) + (ranks - 1) * static_cast<double>(p.impactor->process_bytes)) /
      mebibyte;
  std::printf("memory                   %.0f MiB impactor", memory);
  if (ranks > 1) std::printf(" (%.0f MiB each of %d ranks)", memory / ranks, ranks);
  std::printf(", %.0f MiB structure\n", static_cast<double>(p.structure->memory_bytes) / mebibyte);
  std::printf("estimated time           %s impactor%s, %s structure, at the same time on a core each\n",
              duration_text(cost->impactor / ranks).c_str(),
              ranks > 1 ? (" (" + std::to_string(ranks) + " ranks at their best)").c_str() : "",
              duration_text(cost->structure).c_str());
}

// For this scene: its size and duration may be other ones than the measured.
std::string time_text(const scene::Scene& scene) {
  try {
    const auto cost = cost_of(prepare(scene, {}));
    const double seconds = cost ? std::max(cost->impactor, cost->structure) : 0.0;
    return seconds < 1.0 ? "about a second" : "about " + duration_text(seconds);
  } catch (const InputError&) {  // too few particles for this slug, too coarse a mesh for this beam
    return "not possible here";
  }
}

void print_recommendation(double percent, const scene::Scene& scene) {
  const Fidelity* one = cheapest_within(percent, measured_fidelities());
  if (one == nullptr) {
    return;
  }
  const scene::Scene better = at_fidelity(scene, *one);
  std::printf("for errors below %3.2g%%    D = %.3g mm, mesh h/%g (a/D = %g, measured %.2g%%): %s\n", percent,
              1e3 * better.impactor().slug().particle().diameter(), one->refinement, one->particles_across,
              one->error_deflection, time_text(better).c_str());
}

void print_fidelity(const scene::Scene& scene) {
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
    print_recommendation(percent, scene);
  }
}

}  // namespace

void check(const CheckOptions& options) {
  RunOptions run;
  run.scene = options.scene;
  run.ranks = options.ranks;
  const Preparation p = prepare(run);
  print_warnings(p);
  std::printf("%s\n", p.scene.title().empty() ? options.scene.scene.c_str() : p.scene.title().c_str());
  print_groups(p.groups);
  print_sides(p);
  if (p.plan) {
    print_plan(*p.plan);
  }
  print_cost(p, options.ranks);
  require_memory(p, options.ranks, memory_of_machine());
  print_fidelity(p.scene);
}

}  // namespace grainstep::orchestrator
