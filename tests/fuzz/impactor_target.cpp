/// @file A lying orchestrator, and our own impactors that need no LAMMPS: prescribed loads and foam projectiles.
#include "fe-service/impactor.hpp"
#include "participant_trial.hpp"
#include "target.hpp"

namespace grainstep::fuzz {
namespace {

double elements_of(const wire::Setup& setup) {
  const scene::Impactor& impactor = setup.impactor().impactor();
  const double rows = impactor.foam().elements();
  return rows * rows * impactor.slug().half_width() / impactor.slug().height();
}

}  // namespace

void try_script(const Script& script) {
  fe::Impactor impactor;
  try_participant(script, impactor, elements_of);
}

}  // namespace grainstep::fuzz
