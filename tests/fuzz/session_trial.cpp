#include "session_trial.hpp"

#include "base/assert.hpp"
#include "base/error.hpp"
#include "honest_peer.hpp"
#include "liar.hpp"
#include "played_scene.hpp"
#include "statistics.hpp"

namespace grainstep::fuzz {
namespace {

using namespace orchestrator;

/// Nobody waits: who does not answer at once has been silent for too long. The end is tried once.
constexpr Deadlines at_once{.connect_s = 0.0, .step_s = 0.0, .stop_s = 2e-5};

class Conversation {
 public:
  Conversation(const Script& script, const Trial& trial)
      : trial_(trial),
        scene_(played_scene(trial.symmetry)),
        liar_(script, name_of(trial.liar)),
        honest_(trial.liar == wire::IMPACTOR ? wire::STRUCTURE : wire::IMPACTOR, trial.dimension()),
        hub_(trial.liar == wire::IMPACTOR ? channel(liar_) : channel(honest_),
             trial.liar == wire::IMPACTOR ? channel(honest_) : channel(liar_), loop_),
        session_(hub_, {.scene = scene_, .hash = scene_hash, .end = run_end, .preview = trial.preview}, at_once) {}

  void go(const ObserverOf& observer_of) {
    session_.introduce();
    if (trial_.preview) {
      session_.ask();
      return session_.end();
    }
    const StepPlan plan = session_.prepare();
    observer_ = observer_of(scene_, hub_, plan);
    session_.run(plan, *observer_);
  }

  void abandon(const std::string& reason, const std::string& lost) { session_.abandon(reason, lost); }

  [[nodiscard]] bool running() const { return observer_ != nullptr; }

 private:
  static transport::Channel& channel(transport::Channel& one) { return one; }

  const Trial& trial_;
  scene::Scene scene_;
  Liar liar_;
  HonestPeer honest_;
  EventLoop loop_;
  Hub hub_;
  std::unique_ptr<StepObserver> observer_;  // a late message may still be handed to it: outlives the session
  Session session_;
};

}  // namespace

Trial Trial::of(const Script& script) {
  constexpr scene::Symmetry symmetries[] = {scene::SYMMETRY_PLANE_STRAIN, scene::SYMMETRY_NONE,
                                            scene::SYMMETRY_AXISYMMETRIC, scene::SYMMETRY_PLANE_STRAIN};
  const std::uint32_t variant = script.variant();
  return {.liar = (variant & 1U) != 0 ? wire::STRUCTURE : wire::IMPACTOR,
          .symmetry = symmetries[(variant >> 1U) % 4],
          .preview = (variant >> 1U) % 4 == 3};
}

void try_session(const Script& script, const ObserverOf& observer_of) {
  const Trial trial = Trial::of(script);
  const std::string liar = orchestrator::name_of(trial.liar);
  Conversation talk(script, trial);
  try {
    talk.go(observer_of);
    ++statistics().complete;
    return;
  } catch (const PeerError& error) {
    GS_ASSERT(error.peer() == liar, "the " + liar + " lied, but this is told: " + error.what());
    talk.abandon(error.what(), error.peer());
  } catch (const InputError& error) {
    const bool his_own = std::string(error.what()).starts_with(liar + ": ");
    GS_ASSERT(his_own || !talk.running(), "the " + liar + " lied, the scene is blamed: " + error.what());
    talk.abandon(error.what(), "");
  } catch (const NumericalError& error) {
    talk.abandon(error.what(), "");
  }
  ++statistics().blamed;
}

}  // namespace grainstep::fuzz
