#include "orchestrator/preparation.hpp"

#include "orchestrator/participants.hpp"
#include "scene/load.hpp"

namespace grainstep::orchestrator {

Preparation prepare(const RunOptions& options) {
  Preparation out;
  out.scene = scene::load_scene(options.scene.scene, options.scene.set);
  out.hash = scene::scene_hash(out.scene);
  out.yaml = scene::to_yaml(out.scene);
  out.groups = scene::groups(out.scene);
  const scene::Scene& scene = out.scene;
  const bool mirror = scene.structure().extent() == scene::Structure::EXTENT_HALF;
  if (!is_external(wire::STRUCTURE, scene, options)) {
    out.structure = fe::preview(scene.structure(), scene.symmetry(), scene.depth());
  }
  if (!is_external(wire::IMPACTOR, scene, options)) {
    out.impactor = dem::preview(scene.impactor(), scene.symmetry(), scene.depth(), mirror);
  }
  if (out.impactor && out.structure) {
    out.plan = plan_steps(scene, out.groups.end, {out.impactor->stable_step, out.impactor->preferred_step},
                          {out.structure->stable_step, out.structure->preferred_step});
  }
  return out;
}

}  // namespace grainstep::orchestrator
