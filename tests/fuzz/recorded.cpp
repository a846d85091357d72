#include "recorded.hpp"

#include <thread>

#include "honest_peer.hpp"
#include "orchestrator/session/session.hpp"
#include "participant/serve.hpp"
#include "transport/in_process_channel.hpp"

namespace grainstep::fuzz {
namespace {

/// The message alone: what differs from run to run is left out.
wire::Envelope message_in(std::span<const std::byte> frame) {
  wire::Envelope out;
  const auto payload = frame.subspan(wire::header_size);
  static_cast<void>(out.ParseFromArray(payload.data(), static_cast<int>(payload.size())));
  if (out.has_hello()) out.mutable_hello()->set_process(1);
  if (out.has_report()) out.mutable_report()->mutable_timing()->Clear();
  if (out.has_finished()) out.mutable_finished()->mutable_timing()->Clear();
  return out;
}

/// Keeps what passes through one end, and how much had passed the other way before.
class Recording final : public transport::Channel {
 public:
  Recording(transport::Channel& real, Script& sent, Script& received) : real_(real), sent_(sent), received_(received) {}

  void send(std::span<const std::byte> message) override {
    keep(message, sent_, received_);
    real_.send(message);
  }

  [[nodiscard]] bool receive(transport::Bytes& message, transport::Deadline deadline) override {
    if (!real_.receive(message, deadline)) return false;
    keep(message, received_, sent_);
    return true;
  }

  [[nodiscard]] int wakeup() const override { return real_.wakeup(); }

 private:
  static void keep(std::span<const std::byte> message, Script& here, const Script& there) {
    Said& said = *here.add_said();
    *said.mutable_message() = message_in(message);
    said.set_after(static_cast<std::uint32_t>(there.said_size()));
  }

  transport::Channel& real_;
  Script& sent_;
  Script& received_;
};

class Witness final : public orchestrator::StepObserver {
  void forces(const wire::Forces& /*forces*/) override {}
  void report(wire::Role /*side*/, const wire::Report& /*report*/) override {}
  void snapshot(wire::Role /*side*/, wire::Snapshot /*snapshot*/) override {}
  void idle() override {}
  void finish() override {}
};

void converse(transport::Channel& impactor, transport::Channel& structure, const Task& task) {
  orchestrator::EventLoop loop;
  orchestrator::Hub hub(impactor, structure, loop);
  orchestrator::Session session(hub, {.scene = task.scene, .hash = task.hash, .end = task.end}, {});
  Witness witness;
  session.introduce();
  session.run(session.prepare(), witness);
}

}  // namespace

Recorded record(const Task& task, participant::ImpactorBackend& impactor, participant::StructureBackend& structure) {
  Recorded out;
  auto [to_impactor, impactor_end] = transport::make_in_process_pair();
  auto [to_structure, structure_end] = transport::make_in_process_pair();
  std::thread particles([&, end = std::move(impactor_end)] {
    Recording channel(*end, out.impactor, out.to_impactor);
    static_cast<void>(participant::serve_impactor(channel, impactor));
  });
  std::thread elements([&, end = std::move(structure_end)] {
    Recording channel(*end, out.structure, out.to_structure);
    static_cast<void>(participant::serve_structure(channel, structure));
  });
  try {
    converse(*to_impactor, *to_structure, task);
  } catch (...) {
    to_impactor.reset();
    to_structure.reset();
    particles.join();
    elements.join();
    throw;
  }
  particles.join();
  elements.join();
  return out;
}

Recorded record_honest(const Task& task, unsigned dimension) {
  Recorded out;
  HonestPeer impactor(wire::IMPACTOR, dimension);
  HonestPeer structure(wire::STRUCTURE, dimension);
  Recording from_impactor(impactor, out.to_impactor, out.impactor);
  Recording from_structure(structure, out.to_structure, out.structure);
  converse(from_impactor, from_structure, task);
  return out;
}

}  // namespace grainstep::fuzz
