#include "orchestrator/step_plan.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.hpp"
#include "participant/schedule.hpp"

namespace grainstep::orchestrator {
namespace {

// Steps are written with a few digits; closer than this to a whole ratio they mean it.
constexpr double whole_tolerance = 1e-6;
// What a quotient of two doubles may lie off the integer that it is.
constexpr double round_off = 1e-9;

constexpr double steps_per_contact = 10.0;  // an impactor's preferred step is t_e/10 (physics: dt = t_e/10)

// A foam's nodes swing on their contacts within a few of its steps, and all at once where the block's face arrives:
// with four or more steps in a window the exchange takes 1 to 2% of the energy, with two 0.01% (docs/theory/foam.md).
constexpr double foam_steps_per_window = 2.0;

[[noreturn]] void refuse(const std::string& where, const std::string& text) { throw InputError(where + ": " + text); }

std::string number(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

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
  if (step.value_case() == scene::Step::kRatio && side.preferred >= participant::no_step_limit) {
    refuse("steps.impactor",
           "a bare number is a contact time over the step, but this impactor has no contacts. Write "
           "seconds with a unit, or auto.");
  }
  if (step.value_case() == scene::Step::kSeconds) {
    seconds = step.seconds();
  } else if (step.value_case() == scene::Step::kRatio) {
    seconds = steps_per_contact * side.preferred / step.ratio();
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

// A window is no longer than a contact, because the surface moves linearly in it; that also bounds the window of a
// target that has no stable step of its own.
void choose_structure_steps(StepPlan& plan, double preferred, double contact_time) {
  if (std::min(preferred, contact_time) >= participant::no_step_limit) return;  // one to one
  const double ratio = std::min(preferred, contact_time) / plan.impactor_step;
  plan.impactor_steps = steps_per_window(std::max(1.0, std::floor(ratio * (1.0 + round_off))));
  plan.structure_steps = steps_per_window(std::max(1.0, std::ceil(plan.impactor_steps / ratio * (1.0 - round_off))));
}

// Where what touches outweighs the surface's nodes, the surface moves as much as the particle does during a contact,
// and an impulse that acts a part of a window late makes energy of that: no delay at all, then
// (docs/decisions/0006-lock-step.md).
bool needs_equal_steps(SideSteps impactor, SideSteps structure) {
  return structure.contact_mass > 0.0 && impactor.contact_mass > structure.contact_mass;
}

// Both steps `auto` where the impactor's is not given: then the shorter one is taken by both.
void choose_equal_steps(StepPlan& plan, const scene::Step& impactor, double preferred) {
  if (impactor.value_case() != scene::Step::kSeconds && impactor.value_case() != scene::Step::kRatio) {
    plan.impactor_step = std::min(plan.impactor_step, preferred);
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

std::uint64_t every(std::uint64_t windows, std::uint64_t times) {
  return times == 0 ? 0 : std::max<std::uint64_t>(1, (windows + times / 2) / times);
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
    const bool foam = scene.impactor().type() == scene::Impactor::TYPE_FOAM;
    const double longest = foam ? foam_steps_per_window * plan.impactor_step : steps_per_contact * impactor.preferred;
    choose_structure_steps(plan, structure.preferred, longest);
  }
  plan.window = plan.impactor_steps * plan.impactor_step;
  if (plan.structure_fixed) require_short_window(plan.window, steps_per_contact * impactor.preferred);
  plan.structure_step = plan.window / plan.structure_steps;
  if (plan.structure_fixed && plan.impactor_steps > 1 && plan.window > end * (1.0 + round_off)) {
    refuse("steps.structure", "a step of " + number(plan.window) + " s is longer than the whole run of " + number(end) +
                                  " s. Write a smaller one, or auto.");
  }
  plan.windows = count("time.end", "windows of " + number(plan.window) + " s",
                       std::max(1.0, std::ceil(end / plan.window * (1.0 - round_off))), most_windows);
  plan.report_every = every(plan.windows, scene.output().rows());
  const std::uint32_t snapshots = scene.output().snapshots();  // the first of them at the start
  plan.snapshot_every = snapshots == 1 ? plan.windows + 1 : every(plan.windows, snapshots == 0 ? 0 : snapshots - 1);
  plan.profile_every = every(plan.windows, scene.output().profiles());
  return plan;
}

}  // namespace grainstep::orchestrator
