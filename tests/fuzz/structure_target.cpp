/// @file A lying orchestrator, and our own structure: beams, plates, rigid targets.
#include "fe-service/structure.hpp"
#include "participant_trial.hpp"
#include "target.hpp"

namespace grainstep::fuzz {
namespace {

double elements_of(const wire::Setup& setup) {
  const scene::Structure& structure = setup.structure().structure();
  if (structure.layers().empty()) return 0.0;
  double thickness = 0.0;
  for (const scene::Layer& layer : structure.layers()) thickness += layer.thickness();
  const double first = structure.layers(0).thickness();
  const double size = (structure.layers_size() == 1 ? 0.5 : 1.0) * first / structure.mesh().refinement();
  return structure.half_span() / size * (thickness / size);
}

}  // namespace

void try_script(const Script& script) {
  fe::Structure structure;
  try_participant(script, structure, elements_of);
}

}  // namespace grainstep::fuzz
