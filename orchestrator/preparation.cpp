#include "orchestrator/preparation.hpp"

#include <cstdio>

#include "base/number_text.hpp"
#include "dem-service/preview.hpp"
#include "dem-service/slug_model.hpp"
#include "orchestrator/participants.hpp"
#include "participant/schedule.hpp"
#include "scene/load.hpp"

namespace grainstep::orchestrator {

namespace {

// A prescribed load follows the structure's steps.
ImpactorPreview without_mass() {
  ImpactorPreview out;
  out.stable_step = out.preferred_step = participant::no_step_limit;
  return out;
}

ImpactorPreview of_slug(const scene::Scene& scene, bool mirror) {
  const dem::SlugPreview slug = dem::preview(scene.impactor(), scene.symmetry(), scene.depth(), mirror);
  return {.particles = slug.particles,
          .mass = slug.mass,
          .smallest = slug.smallest,
          .largest = slug.largest,
          .contact_mass = slug.contact_mass,
          .contact_time = slug.contact_time,
          .stable_step = slug.stable_step,
          .preferred_step = slug.preferred_step,
          .memory_bytes = slug.memory_bytes,
          .process_bytes = slug.process_bytes,
          .seconds_per_step = static_cast<double>(slug.particles) * slug.seconds_per_particle_step};
}

ImpactorPreview of_foam(const scene::Scene& scene, bool mirror) {
  const fe::FoamPreview foam = fe::preview_foam(scene.impactor(), {scene.symmetry(), scene.depth(), mirror});
  return {.elements = foam.elements,
          .contact_mass = foam.contact_mass,
          .contact_time = foam.contact_time,
          .longest_window = foam.longest_window,
          .stable_step = foam.stable_step,
          .preferred_step = foam.preferred_step,
          .memory_bytes = foam.memory_bytes,
          .seconds_per_step = static_cast<double>(foam.elements) * foam.seconds_per_element_step};
}

ImpactorPreview preview_impactor(const scene::Scene& scene, bool mirror) {
  if (has_particles(scene)) return of_slug(scene, mirror);
  return scene.impactor().type() == scene::Impactor::TYPE_FOAM ? of_foam(scene, mirror) : without_mass();
}

/// What a dent under one particle depends on, if its force acts at a point (docs/theory/contact.md).
void point_contact_is_meant(const Preparation& p, std::vector<scene::Finding>& warnings) {
  const scene::SurfaceContact& contact = p.scene.impactor().slug().surface_contact();
  if (contact.spreading() != scene::SurfaceContact::SPREADING_POINT || !p.impactor || !p.structure) return;
  const double elements = p.impactor->largest / p.structure->element_size;
  if (!(p.structure->element_size > 0.0) || !(elements > dem::widest_point_contact)) return;
  warnings.push_back({scene::Severity::warning, "impactor.slug.surface_contact.spreading",
                      "point: a particle is as wide as " + rounded_text(elements) +
                          " elements of the surface, and the dent under it will follow the mesh, with its plastic work "
                          "and the rebound. Write chord (auto takes it from " +
                          rounded_text(dem::widest_point_contact) + " on), or a coarser mesh"});
}

}  // namespace

Preparation prepare(const RunOptions& options) {
  return prepare(scene::load_scene(options.scene.scene, options.scene.set), options);
}

Preparation prepare(scene::Scene loaded, const RunOptions& options) {
  Preparation out;
  out.scene = std::move(loaded);
  if (options.ranks > 1 && !has_particles(out.scene)) {
    throw InputError("--ranks " + std::to_string(options.ranks) +
                     ": an impactor without particles is one process; leave --ranks out");
  }
  check_connection(out.scene, options);
  out.hash = scene::scene_hash(out.scene);
  out.yaml = scene::to_yaml(out.scene);
  for (scene::Finding& finding : scene::check_rules(out.scene)) {
    if (finding.severity == scene::Severity::warning) out.warnings.push_back(std::move(finding));
  }
  const scene::Scene& scene = out.scene;
  const bool mirror = scene::has_mirror(scene);
  if (!is_external(wire::STRUCTURE, scene, options)) {
    out.structure = fe::preview(scene.structure(), scene.symmetry(), scene.depth());
  }
  if (!is_external(wire::IMPACTOR, scene, options)) {
    out.impactor = preview_impactor(scene, mirror);
  }
  point_contact_is_meant(out, out.warnings);
  const bool weighed = out.impactor && out.impactor->mass > 0.0;
  out.groups = scene::groups(scene, weighed ? std::optional(out.impactor->mass) : std::nullopt);
  if (out.impactor && out.structure) {
    out.plan = plan_steps(scene, out.groups.end,
                          {.stable = out.impactor->stable_step,
                           .preferred = out.impactor->preferred_step,
                           .contact_mass = out.impactor->contact_mass,
                           .contact_time = out.impactor->contact_time,
                           .longest_window = out.impactor->longest_window},
                          {.stable = out.structure->stable_step,
                           .preferred = out.structure->preferred_step,
                           .contact_mass = out.structure->contact_mass,
                           .free_mass = out.structure->free_mass});
  }
  return out;
}

void print_warnings(const Preparation& preparation, const std::string& of) {
  for (const scene::Finding& warning : preparation.warnings) {
    std::fprintf(stderr, "grainstep: warning: %s%s: %s\n", of.c_str(), warning.path.c_str(), warning.text.c_str());
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
  return Cost{.impactor = windows * p.plan->impactor_steps * p.impactor->seconds_per_step,
              .structure = windows * p.plan->structure_steps * static_cast<double>(p.structure->elements) *
                           p.structure->seconds_per_element_step};
}

}  // namespace grainstep::orchestrator
