#include "orchestrator/preparation.hpp"

#include "orchestrator/participants.hpp"
#include "participant/schedule.hpp"
#include "scene/load.hpp"

namespace grainstep::orchestrator {

namespace {

// An impactor without particles follows the structure's steps.
dem::ImpactorPreview without_particles() {
  dem::ImpactorPreview out;
  out.stable_step = out.preferred_step = participant::no_step_limit;
  return out;
}

}  // namespace

Preparation prepare(const RunOptions& options) {
  return prepare(scene::load_scene(options.scene.scene, options.scene.set), options);
}

Preparation prepare(scene::Scene loaded, const RunOptions& options) {
  Preparation out;
  out.scene = std::move(loaded);
  out.hash = scene::scene_hash(out.scene);
  out.yaml = scene::to_yaml(out.scene);
  out.groups = scene::groups(out.scene);
  const scene::Scene& scene = out.scene;
  const bool mirror = scene.structure().extent() == scene::Structure::EXTENT_HALF;
  if (!is_external(wire::STRUCTURE, scene, options)) {
    out.structure = fe::preview(scene.structure(), scene.symmetry(), scene.depth());
  }
  if (!is_external(wire::IMPACTOR, scene, options)) {
    out.impactor = has_particles(scene) ? dem::preview(scene.impactor(), scene.symmetry(), scene.depth(), mirror)
                                        : without_particles();
  }
  if (out.impactor && out.structure) {
    out.plan = plan_steps(scene, out.groups.end,
                          {out.impactor->stable_step, out.impactor->preferred_step, out.impactor->particle_mass},
                          {out.structure->stable_step, out.structure->preferred_step, out.structure->contact_mass});
  }
  return out;
}

std::optional<Cost> cost_of(const Preparation& p) {
  if (!p.plan) {
    return std::nullopt;
  }
  const auto windows = static_cast<double>(p.plan->windows);
  return Cost{.impactor = windows * p.plan->impactor_steps * static_cast<double>(p.impactor->particles) *
                          p.impactor->seconds_per_particle_step,
              .structure = windows * p.plan->structure_steps * static_cast<double>(p.structure->elements) *
                           p.structure->seconds_per_element_step};
}

}  // namespace grainstep::orchestrator
