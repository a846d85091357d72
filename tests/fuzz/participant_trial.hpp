/// @file A participant that is served to a lying orchestrator.
#pragma once

#include "bounded.hpp"
#include "participant/serve.hpp"
#include "script.pb.h"

namespace grainstep::fuzz {

/// Serves it until the end. The exit code must be one of those that a participant's errors have, and the one line of
/// text must be there. `elements_of`: of models that take time and memory.
void try_participant(const Script& script, participant::StructureBackend& backend, const ElementsOf& elements_of = {});
void try_participant(const Script& script, participant::ImpactorBackend& backend, const ElementsOf& elements_of = {});

}  // namespace grainstep::fuzz
