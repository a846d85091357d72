/// @file A whole session of the orchestrator: a lying participant, an honest one, and nobody who records.
#include "session_trial.hpp"
#include "target.hpp"

namespace grainstep::fuzz {
namespace {

class Nobody final : public orchestrator::StepObserver {
  void forces(const wire::Forces& /*forces*/) override {}
  void report(wire::Role /*side*/, const wire::Report& /*report*/) override {}
  void snapshot(wire::Role /*side*/, wire::Snapshot /*snapshot*/) override {}
  void idle() override {}
  void finish() override {}
};

}  // namespace

void try_script(const Script& script) {
  try_session(script, [](const scene::Scene&, orchestrator::Hub&, const orchestrator::StepPlan&) {
    return std::make_unique<Nobody>();
  });
}

}  // namespace grainstep::fuzz
