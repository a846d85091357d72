#include "scene/foam_rules.hpp"

#include <cmath>

#include "base/number_text.hpp"
#include "scene/foam.hpp"

namespace grainstep::scene {
namespace {

using Findings = std::vector<Finding>;

void foam_follows_from(const Scene& scene, Findings& findings) {
  const Slug& slug = scene.impactor().slug();
  if (!(slug.speed() > 0)) {
    findings.push_back({Severity::error, "impactor.slug.speed",
                        "found 0, but a foam's strength and viscosity follow from its speed; expected more"});
  }
  const double densest = densest_packing(scene.impactor().foam(), scene.symmetry());
  if (slug.relative_density() < densest) return;
  findings.push_back({Severity::error, "impactor.foam.densest",
                      "found " + rounded_text(densest) + ", but the slug's relative density is " +
                          rounded_text(slug.relative_density()) + ": nothing would be left to compact; expected more"});
}

/// Behind the shock a foam is elastic with strains of p/M, and its rate form is for small ones: what is stored is given
/// back, but a node sinks by p/M of an element into what it touches and the block springs back with p/M of its energy.
void foam_stays_stiff(const Scene& scene, Findings& findings) {
  constexpr double noticed = 0.05;
  constexpr double most = 0.15;  // with 0.12 runs end well, with 0.17 nodes pass into the structure or grow unstable
  const double strain = strain_behind_shock(scene);
  if (!(strain > noticed)) return;
  const std::string found = "the foam's pressure behind the shock, rho_bar rho_s v0^2/(1 - rho_bar/rho_max), is " +
                            rounded_text(strain) + " of its modulus (from normal_stiffness)";
  if (strain > most) {
    findings.push_back(
        {Severity::error, "impactor.foam",
         found + "; up to " + rounded_text(most) +
             " can be computed. Take a stiffer particle.normal_stiffness, a lower speed or relative_density, or "
             "impactor.type: slug"});
  } else {
    findings.push_back({Severity::warning, "impactor.foam",
                        found + ": what has locked strains by that, and springs back; below " + rounded_text(noticed) +
                            " it is nearly rigid, as (4.12) has it"});
  }
}

/// A shock within a part of an element loads too much: 1% of w_max with half of one, 4% with a quarter.
void foam_resolves_its_shock(const Foam& foam, Findings& findings) {
  constexpr double narrowest = 0.5;
  const double found = foam.shock_width() * foam.elements();
  if (found >= narrowest) return;
  findings.push_back({Severity::error, "impactor.foam.shock_width",
                      "found " + rounded_text(foam.shock_width()) + ", which is " + rounded_text(found) +
                          " of an element: no mesh resolves that; expected at least " +
                          rounded_text(narrowest / foam.elements()) + ", better two elements, or more elements"});
}

/// Sand beside the span flies past it. Compacted foam is stiff: what overhangs would push on the rest, up to twice the
/// sand's load.
void foam_stays_on_the_span(const Scene& scene, Findings& findings) {
  const Slug& slug = scene.impactor().slug();
  const double reach = slug.half_width() + std::abs(slug.offset());
  const double half_span = scene.structure().half_span();
  if (reach <= half_span) return;
  findings.push_back({Severity::error, slug.offset() == 0.0 ? "impactor.slug.half_width" : "impactor.slug.offset",
                      "the foam projectile reaches to " + metres(reach) +
                          ", beyond the structure (structure.half_span is " + metres(half_span) +
                          "), and what overhangs it would load it as the slug does not. Take "
                          "impactor.type: slug, or a smaller one"});
}

}  // namespace

void check_foam(const Scene& scene, Findings& findings) {
  foam_follows_from(scene, findings);
  if (findings.empty()) {  // else it has no pressure, or no modulus, to speak of
    foam_stays_stiff(scene, findings);
    foam_resolves_its_shock(scene.impactor().foam(), findings);
  }
  foam_stays_on_the_span(scene, findings);
}

}  // namespace grainstep::scene
