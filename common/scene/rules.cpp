#include "scene/rules.hpp"

#include <algorithm>
#include <cmath>

#include "scene/groups.hpp"
#include "scene/number_text.hpp"

namespace grainstep::scene {
namespace {

using Findings = std::vector<Finding>;

std::string metres(double value) { return rounded_text(value) + " m"; }

/// Ratios are written by people, in decimals: 0.3333 is meant as a third only if it says so to six digits.
constexpr double ratio_tolerance = 1e-6;

bool is_whole(double value) {
  return std::round(value) >= 1 && std::abs(value / std::round(value) - 1) < ratio_tolerance;
}

bool divides_evenly(double ratio) { return is_whole(ratio) || is_whole(1 / ratio); }

void slug_holds_particles(const Slug& slug, Findings& findings) {
  const double diameter = slug.particle().diameter();
  const double smallest = std::min(2 * slug.half_width(), slug.height());
  if (diameter <= smallest) return;
  findings.push_back({Severity::error, "impactor.slug.particle.diameter",
                      "a particle of " + metres(diameter) + " does not fit into a slug of " +
                          metres(2 * slug.half_width()) + " by " + metres(slug.height())});
}

void slug_meets_structure(const Scene& scene, Findings& findings) {
  const double half_width = scene.impactor().slug().half_width();
  const double half_span = scene.structure().half_span();
  if (half_width <= half_span) return;
  findings.push_back({Severity::warning, "impactor.slug.half_width",
                      "the slug (" + metres(half_width) + ") is wider than the structure (structure.half_span is " +
                          metres(half_span) + "): what passes beside it loads nothing"});
}

void slug_moves(const Slug& slug, Findings& findings) {
  if (slug.speed() > 0) return;
  findings.push_back({Severity::warning, "impactor.slug.speed", "a slug at rest: nothing will hit the structure"});
}

void steps_meet(const Steps& steps, Findings& findings) {
  const auto& structure = steps.structure();
  if (structure.has_ratio() && !divides_evenly(structure.ratio())) {
    findings.push_back({Severity::error, "steps.structure",
                        "a ratio of " + rounded_text(structure.ratio()) +
                            " to the impactor's step: the two sides would never meet; expected a whole number or one "
                            "over a whole number"});
  }
  if (!structure.has_seconds() || !steps.impactor().has_seconds()) return;
  const double ratio = structure.seconds() / steps.impactor().seconds();
  if (divides_evenly(ratio)) return;
  findings.push_back(
      {Severity::error, "steps.structure",
       "is " + rounded_text(ratio) +
           " times the impactor's step: the two sides would never meet; expected a whole number of steps "
           "of one in a step of the other"});
}

void step_fits_run(const Step& step, const std::string& path, double end, Findings& findings) {
  if (!step.has_seconds() || step.seconds() <= end) return;
  findings.push_back({Severity::error, path,
                      "a step of " + rounded_text(step.seconds()) + " s is longer than the whole run (time.end is " +
                          rounded_text(end) + " s)"});
}

}  // namespace

std::vector<Finding> check_rules(const Scene& scene) {
  Findings findings;
  const double end = groups(scene).end;
  slug_holds_particles(scene.impactor().slug(), findings);
  slug_meets_structure(scene, findings);
  slug_moves(scene.impactor().slug(), findings);
  steps_meet(scene.steps(), findings);
  step_fits_run(scene.steps().impactor(), "steps.impactor", end, findings);
  step_fits_run(scene.steps().structure(), "steps.structure", end, findings);
  return findings;
}

}  // namespace grainstep::scene
