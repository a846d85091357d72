#include "orchestrator/session/step_plan.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "participant/schedule.hpp"

namespace grainstep::orchestrator {
namespace {

// Steps are written with a few digits; closer than this to a whole ratio they mean it.
constexpr double whole_tolerance = 1e-6;
// What a quotient of two doubles may lie off the integer that it is.
constexpr double round_off = 1e-9;

// Equal steps must stay equal where they are needed, and a dent makes the structure's stable step shorter: this part of
// the undeformed one is taken (docs/decisions/0006-lock-step.md).
constexpr double equal_step_reserve = 0.75;

[[noreturn]] void refuse(const std::string& where, const std::string& text) { throw InputError(where + ": " + text); }

std::string number(double value) { return rounded_text(value, 4); }

void require_stable(const std::string& where, double step, double stable) {
  if (step > stable * (1.0 + round_off)) {
    refuse(where, "a step of " + number(step) + " s was asked for, the largest stable one is " + number(stable) +
                      " s. Write a smaller one, or auto.");
  }
}

// Steps of a run in which neither side has a limit: a mass that a prescribed pressure pushes.
constexpr double unlimited_steps = 1000.0;

// An impactor without a step of its own (a prescribed load) takes the structure's, so that both are equal unless the
// scene says otherwise; where the structure has none either, a part of the run.
double following_step(const scene::Step& structure_step, double end, SideSteps structure) {
  if (structure_step.value_case() == scene::Step::kSeconds) return structure_step.seconds();
  const double own = structure.preferred < participant::no_step_limit ? structure.preferred : end / unlimited_steps;
  return structure_step.value_case() == scene::Step::kRatio ? own / structure_step.ratio() : own;
}

double impactor_step(const scene::Step& step, SideSteps side) {
  double seconds = side.preferred;
  if (step.value_case() == scene::Step::kRatio && !(side.contact_time > 0.0)) {
    refuse("steps.impactor",
           "a bare number is a contact time over the step, but this impactor has no contacts, or does not say how long "
           "they last. Write seconds with a unit, or auto.");
  }
  if (step.value_case() == scene::Step::kSeconds) {
    seconds = step.seconds();
  } else if (step.value_case() == scene::Step::kRatio) {
    seconds = side.contact_time / step.ratio();
  }
  require_stable("steps.impactor", seconds, side.stable);
  return seconds;
}

// Beyond this a count of steps is a slip of the pen, and far beyond it no integer holds it.
constexpr double most_steps_per_window = 1e9;
constexpr double most_windows = 1e15;

std::uint64_t count(const std::string& where, const std::string& what, double value, double most) {
  if (!(value <= most)) {
    refuse(where, "would take " + number(value) + " " + what + ", at most " + number(most) +
                      " can be counted. Ask for longer steps or an earlier end.");
  }
  return static_cast<std::uint64_t>(value);
}

std::uint32_t steps_per_window(double value) {
  return static_cast<std::uint32_t>(count("steps", "steps per window", value, most_steps_per_window));
}

// The surface moves linearly in a window, which must be short against a contact, and no longer than either side allows;
// that also bounds the window of a target that has no stable step of its own.
constexpr double windows_per_contact = 2.0;

double longest_window(SideSteps impactor, SideSteps structure) {
  double longest = participant::no_step_limit;
  for (const double limit :
       {impactor.contact_time / windows_per_contact, impactor.longest_window, structure.longest_window}) {
    if (limit > 0.0) longest = std::min(longest, limit);
  }
  return longest;
}

void choose_structure_steps(StepPlan& plan, double preferred, double longest) {
  if (std::min(preferred, longest) >= participant::no_step_limit) return;  // one to one
  const double ratio = std::min(preferred, longest) / plan.impactor_step;
  plan.impactor_steps = steps_per_window(std::max(1.0, std::floor(ratio * (1.0 + round_off))));
  plan.structure_steps = steps_per_window(std::max(1.0, std::ceil(plan.impactor_steps / ratio * (1.0 - round_off))));
}

// Where what touches outweighs the surface's nodes, the surface moves as much as the particle does during a contact,
// and an impulse that acts a part of a window late makes energy of that: no delay at all, then
// (docs/decisions/0006-lock-step.md). A free rigid body answers as a whole, at once: the same.
bool needs_equal_steps(SideSteps impactor, SideSteps structure) {
  return structure.free_mass > 0.0 || (structure.contact_mass > 0.0 && impactor.contact_mass > structure.contact_mass);
}

// Both steps `auto` where the impactor's is not given: then the shorter one is taken by both.
void choose_equal_steps(StepPlan& plan, const scene::Step& impactor, double preferred) {
  if (preferred >= participant::no_step_limit) return;  // whatever the impactor's step
  if (impactor.value_case() != scene::Step::kSeconds && impactor.value_case() != scene::Step::kRatio) {
    plan.impactor_step = std::min(plan.impactor_step, equal_step_reserve * preferred);
  }
  plan.structure_steps = steps_per_window(std::max(1.0, std::ceil(plan.impactor_step / preferred * (1.0 - round_off))));
}

// `ratio`: structure step over impactor step, which must be an integer or one over an integer.
void honour_structure_ratio(StepPlan& plan, double ratio) {
  const bool longer = ratio >= 1.0;
  const double many = longer ? ratio : 1.0 / ratio;
  const double whole = std::max(1.0, std::round(many));
  if (std::abs(many - whole) > whole_tolerance * whole) {
    const auto step_of = [&](double n) { return number(longer ? n * plan.impactor_step : plan.impactor_step / n); };
    refuse("steps.structure",
           "is " + number(ratio) + " times the impactor's step of " + number(plan.impactor_step) +
               " s, but the sides meet only when this is an integer or one over an integer. The nearest are " +
               step_of(std::floor(many)) + " s and " + step_of(std::floor(many) + 1.0) + " s.");
  }
  (longer ? plan.impactor_steps : plan.structure_steps) = steps_per_window(whole);
  plan.structure_fixed = true;
}

// `auto` never gets there; a step that the scene fixes may.
void require_short_window(double window, double contact_time) {
  if (window > contact_time * (1.0 + round_off)) {
    refuse("steps.structure", "a step of " + number(window) + " s is longer than a contact lasts, " +
                                  number(contact_time) +
                                  " s: the surface moves linearly in between, and would answer after the particle has "
                                  "left. Write a smaller one, or auto.");
  }
}

std::uint64_t count_windows(const StepPlan& plan, double end) {
  return count("time.end", "windows of " + number(plan.window) + " s",
               std::max(1.0, std::ceil(end / plan.window * (1.0 - round_off))), most_windows);
}

// What is recorded falls on the ends of windows: where `auto` chose a long window, it is shortened until there are as
// many as were asked for.
void leave_room_for_output(StepPlan& plan, double end, std::uint64_t intervals) {
  if (plan.structure_fixed || plan.impactor_steps == 1) return;
  const double most = end / (plan.impactor_step * static_cast<double>(intervals)) * (1.0 + round_off);
  if (most >= plan.impactor_steps) return;
  plan.impactor_steps = static_cast<std::uint32_t>(std::max(1.0, std::floor(most)));
}

/// Windows between two of `times` events that are spread over all of them, the first at the start and the last at the
/// end; at least one. Notes where there are too few windows.
double spacing(StepPlan& plan, const char* key, std::uint64_t times, std::uint64_t intervals) {
  if (plan.windows < intervals) {
    plan.warnings.push_back(std::string("output.") + key + ": " + std::to_string(times) +
                            " were asked for, but the run has only " + std::to_string(plan.windows) +
                            " windows: there will be one at the end of each. Smaller steps make more.");
  }
  return std::max(1.0, static_cast<double>(plan.windows) / static_cast<double>(intervals));
}

/// Intervals between so many states, the first and the last of a run among them.
std::uint64_t between(std::uint64_t states) { return std::max<std::uint64_t>(1, states - 1); }

void choose_output(StepPlan& plan, const scene::Output& output) {
  plan.report_every = spacing(plan, "rows", output.rows(), between(output.rows()));
  if (output.snapshots() == 1) plan.snapshot_every = static_cast<double>(plan.windows) + 1.0;
  if (output.snapshots() > 1) {
    plan.snapshot_every = spacing(plan, "snapshots", output.snapshots(), between(output.snapshots()));
  }
  if (output.profiles() > 0) plan.profile_every = spacing(plan, "profiles", output.profiles(), output.profiles());
}

}  // namespace

wire::Start StepPlan::start() const {
  wire::Start out;
  out.set_window(window);
  out.set_windows(windows);
  out.set_impactor_steps(impactor_steps);
  out.set_structure_steps(structure_steps);
  out.set_structure_fixed(structure_fixed);
  out.set_report_every(report_every);
  out.set_snapshot_every(snapshot_every);
  return out;
}

SideSteps steps_of(const wire::Ready& ready) {
  return {.stable = ready.stable_step(),
          .preferred = ready.preferred_step(),
          .contact_mass = ready.contact_mass(),
          .contact_time = ready.contact_time(),
          .longest_window = ready.longest_window(),
          .free_mass = ready.free_mass()};
}

StepPlan plan_steps(const scene::Scene& scene, double end, SideSteps impactor, SideSteps structure) {
  StepPlan plan;
  const bool follows = impactor.preferred >= participant::no_step_limit &&
                       scene.steps().impactor().value_case() != scene::Step::kSeconds;
  plan.impactor_step = impactor_step(scene.steps().impactor(), impactor);
  if (follows) plan.impactor_step = following_step(scene.steps().structure(), end, structure);
  const scene::Step& asked = scene.steps().structure();
  if (asked.value_case() == scene::Step::kSeconds) {
    require_stable("steps.structure", asked.seconds(), structure.stable);
    honour_structure_ratio(plan, asked.seconds() / plan.impactor_step);
  } else if (asked.value_case() == scene::Step::kRatio) {
    require_stable("steps.structure", asked.ratio() * plan.impactor_step, structure.stable);
    honour_structure_ratio(plan, asked.ratio());
  } else if (needs_equal_steps(impactor, structure)) {
    choose_equal_steps(plan, scene.steps().impactor(), structure.preferred);
  } else {
    choose_structure_steps(plan, structure.preferred, longest_window(impactor, structure));
  }
  const scene::Output& output = scene.output();
  leave_room_for_output(plan, end,
                        std::max({between(output.rows()), between(std::max(1U, output.snapshots())),
                                  std::uint64_t{std::max(1U, output.profiles())}}));
  plan.window = plan.impactor_steps * plan.impactor_step;
  if (plan.structure_fixed && impactor.contact_time > 0.0) require_short_window(plan.window, impactor.contact_time);
  plan.structure_step = plan.window / plan.structure_steps;
  if (plan.structure_fixed && plan.impactor_steps > 1 && plan.window > end * (1.0 + round_off)) {
    refuse("steps.structure", "a step of " + number(plan.window) + " s is longer than the whole run of " + number(end) +
                                  " s. Write a smaller one, or auto.");
  }
  plan.windows = count_windows(plan, end);
  choose_output(plan, output);
  return plan;
}

}  // namespace grainstep::orchestrator
