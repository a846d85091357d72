/// @file The envelope: Protobuf's parsing, and every check that the orchestrator makes on what a participant says.
#include "base/assert.hpp"
#include "base/error.hpp"
#include "framing.hpp"
#include "ledger/message_numbers.hpp"
#include "liar.hpp"
#include "mutate.hpp"
#include "mutate_fields.hpp"
#include "orchestrator/session/check_ready.hpp"
#include "orchestrator/session/check_report.hpp"
#include "orchestrator/session/step_plan.hpp"
#include "played_scene.hpp"
#include "session_trial.hpp"
#include "target.hpp"

namespace grainstep::fuzz {
namespace {

using namespace orchestrator;

class Checks {
 public:
  Checks(const Script& script, const Trial& trial)
      : script_(script),
        liar_(script_, name_of(trial.liar)),
        scene_(played_scene(trial.symmetry)),
        peer_(trial.liar, liar_),
        check_(trial.dimension()) {
    demands_.dimension = trial.dimension();
    demands_.needs = scene::needs(scene_, trial.liar);
    demands_.scene_hash = scene_hash;
  }

  void look_at(const wire::Frame& frame) {
    if (frame.kind == wire::Envelope::kError) throw_error_of(peer_, frame);
    if (wire::parse(frame, peer_.hello)) check_hello(peer_, demands_);
    if (wire::parse(frame, peer_.ready)) {
      check_ready(peer_, demands_);
      const SideSteps one = steps_of(peer_.ready);
      static_cast<void>(plan_steps(scene_, run_end, one, one));
    }
    if (wire::Report report; wire::parse(frame, report)) {
      static_cast<void>(ledger::first_not_finite(report));
      check_.report(peer_, report);
    }
    if (wire::Snapshot snapshot; wire::parse(frame, snapshot)) check_.snapshot(peer_, snapshot);
  }

 private:
  const Script& script_;
  Liar liar_;
  scene::Scene scene_;
  Peer peer_;
  ReportCheck check_;
  Demands demands_;
};

void arrive(Checks& checks, std::span<const std::byte> bytes, wire::Decoder& decoder, const std::string& liar) {
  ++statistics().messages;
  try {
    checks.look_at(decoder.decode(bytes));
    ++statistics().complete;
    return;
  } catch (const PeerError& error) {
    GS_ASSERT(error.peer() == liar, error.what());
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
  ++statistics().blamed;
}

/// The same message with other lies, some times over.
void arrive_changed(Checks& checks, wire::Envelope message, const std::string& liar, Random& random) {
  constexpr int times = 6;
  for (int i = 0; i < times; ++i) {
    change_field(message, random);
    const std::string payload = message.SerializeAsString();
    wire::Encoder encoder;
    wire::Decoder decoder(liar);
    arrive(checks, encoder.forward(std::as_bytes(std::span(payload))), decoder, liar);
  }
}

}  // namespace

void try_script(const Script& script) {
  const Trial trial = Trial::of(script);
  const std::string liar = orchestrator::name_of(trial.liar);
  Checks checks(script, trial);
  Framing framing;
  wire::Decoder decoder(liar);
  Random random(script.variant() + script.ByteSizeLong());
  for (const Said& said : script.said()) {
    const transport::Bytes bytes(framing.frame_of(said));
    arrive(checks, bytes, decoder, liar);
    arrive_changed(checks, said.message(), liar, random);
  }
}

}  // namespace grainstep::fuzz
