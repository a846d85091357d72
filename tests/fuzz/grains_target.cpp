/// @file A lying orchestrator, and our own particle engine, the one that needs no LAMMPS.
#include "dem-service/native/impactor.hpp"
#include "dem-service/slug/preview.hpp"
#include "participant_trial.hpp"
#include "target.hpp"

namespace grainstep::fuzz {
namespace {

/// Grains, in place of elements. Throws what the engine would throw for the same scene.
double grains_of(const wire::Setup& setup) {
  if (setup.impactor().impactor().type() != scene::Impactor::TYPE_SLUG) return 0.0;
  return static_cast<double>(
      dem::preview(setup.impactor().impactor(), setup.symmetry(), setup.depth(), setup.mirror()).particles);
}

}  // namespace

void try_script(const Script& script) {
  const auto engine = dem::native::make_impactor();
  try_participant(script, *engine, grains_of);
}

}  // namespace grainstep::fuzz
