/// @file A lying orchestrator, and the participant's side of the conversation with models that cost nothing.
#include "participant_trial.hpp"
#include "target.hpp"
#include "unit/orchestrator/fake_backends.hpp"

namespace grainstep::fuzz {

void try_script(const Script& script) {
  if (script.variant() % 2 == 0) {
    orchestrator::fake::SpringStructure structure;
    return try_participant(script, structure);
  }
  orchestrator::fake::BallImpactor impactor;
  try_participant(script, impactor);
}

}  // namespace grainstep::fuzz
