/// @file The orchestrator's session between a liar and an honest peer.
#pragma once

#include <functional>
#include <memory>

#include "orchestrator/session/session.hpp"
#include "script.pb.h"

namespace grainstep::fuzz {

/// What a script's variant says.
struct Trial {
  wire::Role liar = wire::IMPACTOR;
  scene::Symmetry symmetry = scene::SYMMETRY_PLANE_STRAIN;
  bool preview = false;  ///< Stop in place of Start

  [[nodiscard]] static Trial of(const Script& script);
  [[nodiscard]] unsigned dimension() const { return symmetry == scene::SYMMETRY_NONE ? 3 : 2; }
};

/// Who looks at what passes by, made when the steps are agreed.
using ObserverOf = std::function<std::unique_ptr<orchestrator::StepObserver>(const scene::Scene&, orchestrator::Hub&,
                                                                             const orchestrator::StepPlan&)>;

/// Runs it. A PeerError must name the liar; an InputError may come of what he says before the run, or be his own Error;
/// a NumericalError of his numbers.
void try_session(const Script& script, const ObserverOf& observer_of);

}  // namespace grainstep::fuzz
