#include "scene/encounter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/number_text.hpp"
#include "scene/groups.hpp"
#include "scene/sizes.hpp"

namespace grainstep::scene {
namespace {

using Findings = std::vector<Finding>;

void slug_moves(const Scene& scene, Findings& findings) {
  if (scene.impactor().slug().speed() > 0 || scene.structure().initial_velocity_size() > 0) return;
  findings.push_back({Severity::warning, "impactor.slug.speed", "a slug at rest: nothing will hit the structure"});
}

/// How much of the slug flies past the undeformed structure. An oblique one comes down where it is longer by
/// 1/cos(angle) and further on, by the way that its leading face, which rests on its lower edge, still has to go.
double share_that_passes_by(const Scene& scene) {
  const Slug& slug = scene.impactor().slug();
  const double end = scene.structure().half_span();
  if (dimension(scene) == 3) {
    const double met = std::min(1.0, end / slug.half_width());
    return 1.0 - met * met;
  }
  const double reach = slug.half_width() / std::cos(slug.angle());
  const double middle =
      slug.offset() + (slug.stand_off() + slug.half_width() * std::sin(slug.angle())) * std::tan(slug.angle());
  const double met = std::min(middle + reach, end) - std::max(middle - reach, -end);
  return 1.0 - std::max(met, 0.0) / (2.0 * reach);
}

void slug_meets_the_structure(const Scene& scene, Findings& findings) {
  constexpr double noticed = 0.005;
  const double beside = share_that_passes_by(scene);
  if (beside < noticed) return;
  const Slug& slug = scene.impactor().slug();
  const std::string key = slug.offset() != 0.0 ? "offset" : slug.angle() > 0.0 ? "angle" : "half_width";
  findings.push_back({Severity::warning, "impactor.slug." + key,
                      "about " + rounded_text(std::round(100.0 * beside)) + "% of the slug (half width " +
                          metres(slug.half_width()) + ") flies past the structure (structure.half_span is " +
                          metres(scene.structure().half_span()) + ") and loads nothing"});
}

/// Whether all of it flies past. A slug at an angle moves sideways as it comes down: about that nothing is known
/// exactly.
bool slug_is_beside_the_structure(const Scene& scene, Findings& findings) {
  const Slug& slug = scene.impactor().slug();
  const double nearest = std::abs(slug.offset()) - slug.half_width();
  const double half_span = scene.structure().half_span();
  if (slug.angle() > 0 || nearest < half_span) return false;
  findings.push_back({Severity::error, "impactor.slug.offset",
                      "found " + metres(slug.offset()) + ": the slug begins " + metres(nearest) +
                          " from mid-span and would fly past the structure, which ends at " + metres(half_span)});
  return true;
}

/// As far as the slug alone decides: the structure may come to meet it.
void slug_arrives(const Scene& scene, Findings& findings) {
  if (scene.structure().initial_velocity_size() > 0) return;
  const Groups g = groups(scene);
  if (!(g.arrival >= g.end)) return;  // nor where the end is not known
  findings.push_back({Severity::error, "impactor.slug.stand_off",
                      "found " + metres(scene.impactor().slug().stand_off()) + ": the slug would arrive after " +
                          rounded_text(g.arrival) + " s, but the run ends at " + rounded_text(g.end) +
                          " s; expected a smaller gap or a later time.end"});
}

/// Beyond a quarter of the slug's radius w_max is more than 2% too small, within an eighth 1%
/// (docs/accuracy-plates.md).
constexpr double largest_hole = 0.15;  // over the slug's radius

/// Above a third of it grainstep-dem refuses the slice as too narrow for its spheres.
constexpr double refused_hole = 1.0 / 3.0;

void slice_reaches_the_axis(const Scene& scene, Findings& findings) {
  if (scene.symmetry() != SYMMETRY_AXISYMMETRIC) return;
  const Slug& slug = scene.impactor().slug();
  // Sand is missing as far out as its mass is in spheres that do not fit.
  const Sizes sizes(slug, dimension(scene));
  const double by_mass = slug.particle().diameter() * sizes.mean_of_power(4) / sizes.mean_of_power(3);
  const double hole = 0.5 * by_mass / std::sin(0.5 * slug.slice_angle());
  if (hole <= largest_hole * slug.half_width() || hole > refused_hole * slug.half_width()) return;
  findings.push_back({Severity::warning, "impactor.slug.slice_angle",
                      "spheres do not fit into the slice nearer to the axis than " + metres(hole) +
                          " (mean by mass), " + rounded_text(hole / slug.half_width()) +
                          " of the slug's radius: the plate will bend too little; take a wider slice or smaller "
                          "particles, for a ratio of at most " +
                          rounded_text(largest_hole)});
}

/// Small particles between large ones are squeezed: the largest overlap of the reference event over that of equal
/// particles, fitted to ranges of 3 to 8 (docs/decisions/0013-particles-of-many-sizes.md).
double squeeze(const Sizes& sizes) { return std::pow(sizes.largest() / sizes.smallest(), 0.27); }

/// Largest overlap (2.1) of one of the largest particles that meets a rigid wall head-on, over its diameter: a damped
/// oscillator that starts at `speed` with mass m on Kn, whose damping ratio returns the restitution.
double head_on_overlap(const Scene& scene) {
  const Slug& slug = scene.impactor().slug();
  const Particle& particle = slug.particle();
  const bool sphere = dimension(scene) == 3;
  const Sizes sizes(slug, dimension(scene));
  const double d = particle.diameter() * sizes.largest();
  const double volume = std::numbers::pi * d * d * (sphere ? d / 6.0 : scene.depth() / 4.0);
  const double frequency = std::sqrt(particle.normal_stiffness() / (particle.density() * volume));
  const double decay = -std::log(particle.restitution()) / std::numbers::pi;  // zeta/sqrt(1 - zeta^2)
  const double speed = std::max(slug.speed(), slug.tail_speed()) * std::cos(slug.angle());
  return squeeze(sizes) * speed / frequency * std::exp(-decay * std::atan2(1.0, decay)) / d;
}

/// What the guard of the run will say, before the run.
void contact_turns_particles_round(const Scene& scene, Findings& findings) {
  const double overlap = head_on_overlap(scene);
  const double allowed = scene.guards().overlap();
  if (overlap <= allowed) return;
  findings.push_back(
      {Severity::warning, "impactor.slug.particle.normal_stiffness",
       "too soft for this speed: a particle that hits a wall head-on, or is squeezed by larger ones, overlaps by " +
           rounded_text(overlap) + " of its diameter, and guards.overlap stops a run at " + rounded_text(allowed) +
           "; the overlap falls with the root of the stiffness"});
}

}  // namespace

void check_encounter(const Scene& scene, Findings& findings) {
  const bool foam = scene.impactor().type() == Impactor::TYPE_FOAM;
  if (!foam) {
    if (!slug_is_beside_the_structure(scene, findings)) slug_meets_the_structure(scene, findings);
    slug_moves(scene, findings);
    contact_turns_particles_round(scene, findings);
    slice_reaches_the_axis(scene, findings);
  }
  if (scene.impactor().slug().speed() > 0) slug_arrives(scene, findings);
}

}  // namespace grainstep::scene
