/// @file The same session, recorded: ledgers, guards, results.h5 and ParaView's files, written as in a run. TMPDIR says
/// where.
#include "base/temporary_directory.hpp"
#include "orchestrator/record/recorder.hpp"
#include "scene/groups.hpp"
#include "session_trial.hpp"
#include "target.hpp"

namespace grainstep::fuzz {
namespace {

const results::RunDirectory& directory() {
  static const TemporaryDirectory home;
  static const results::RunDirectory run(home.path());
  return run;
}

/// A recorder and all that it refers to.
class Recording final : public orchestrator::StepObserver {
 public:
  Recording(const scene::Scene& scene, orchestrator::Hub& hub, const orchestrator::StepPlan& plan)
      : scene_(scene),
        plan_(plan),
        surface_(hub.structure().ready.surface()),
        groups_(scene::groups(scene)),
        lock_(directory().prepare(results::Existing::replace)),
        file_(directory().results(), {}),
        recorder_({.scene = scene_,
                   .groups = groups_,
                   .plan = plan_,
                   .surface = surface_,
                   .masses = {hub.impactor().ready.mass(), hub.structure().ready.mass()},
                   .levels = {hub.impactor().ready.ledger(), hub.structure().ready.ledger()}},
                  directory(), file_, nullptr) {}

  void forces(const wire::Forces& forces) override { recorder_.forces(forces); }
  void report(wire::Role side, const wire::Report& report) override { recorder_.report(side, report); }
  void snapshot(wire::Role side, wire::Snapshot snapshot) override { recorder_.snapshot(side, std::move(snapshot)); }
  void idle() override {}
  void finish() override {
    recorder_.finish();
    static_cast<void>(recorder_.findings());
  }

 private:
  scene::Scene scene_;
  orchestrator::StepPlan plan_;
  wire::Surface surface_;
  scene::Groups groups_;
  results::DirectoryLock lock_;
  results::ResultsFile file_;
  orchestrator::Recorder recorder_;
};

}  // namespace

void try_script(const Script& script) {
  try_session(script, [](const scene::Scene& scene, orchestrator::Hub& hub, const orchestrator::StepPlan& plan) {
    return std::make_unique<Recording>(scene, hub, plan);
  });
}

}  // namespace grainstep::fuzz
