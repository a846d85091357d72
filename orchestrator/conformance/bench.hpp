/// @file Where trials take place: a participant's program, started anew for each of them, and its part of a scene.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/temporary_directory.hpp"
#include "grainstep/scene.pb.h"
#include "orchestrator/session/peer.hpp"
#include "process/child_process.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::conformance {

struct Bench {
  scene::Scene scene;
  wire::Role role;
  process::Command command;  ///< --connect is added to it
  double patience_s = 20.0;  ///< for any one answer
};

/// One process under test. Every wait ends within the bench's patience, with a Breach that says for what it was.
class Subject {
 public:
  explicit Subject(const Bench& bench);

  [[nodiscard]] const orchestrator::Peer& peer() const { return peer_; }
  [[nodiscard]] unsigned dimension() const { return dimension_; }

  void introduce();  ///< its Hello
  /// Setup, Ready. The surface is the structure's own; an impactor is given `surface`.
  void prepare(const wire::Surface& surface = {}, bool preview = false);
  [[nodiscard]] wire::Setup setup(const wire::Surface& surface, bool preview) const;

  template <wire::Body Message>
  void tell(const Message& message) {
    peer_.messages.send(message);
  }
  void tell_bytes(std::span<const std::byte> bytes) { channel_->send(bytes); }

  /// The next message, which has to be this one (of this window, where it has one).
  template <wire::Body Message>
  Message hear(std::optional<std::uint64_t> window = std::nullopt) {
    const wire::Frame& frame = next(wire::kind_name(wire::kind_of<Message>));
    Message out;
    window ? peer_.messages.take(frame, out, *window) : peer_.messages.take(frame, out);
    return out;
  }
  /// Its Error, after whatever it was about to say; where it is gone without one, nothing.
  [[nodiscard]] std::optional<wire::Error> hear_error();
  /// Stop, Finished, and the end of its process with code 0. Data that was on its way is passed over.
  void stop();
  void break_the_connection() { channel_.reset(); }
  /// Waits for its end.
  [[nodiscard]] int exit_code();

 private:
  const wire::Frame& next(const std::string& expected);
  [[nodiscard]] std::string account() const;

  const Bench& bench_;
  TemporaryDirectory folder_;
  std::unique_ptr<transport::ZmqChannel> channel_;
  orchestrator::Peer peer_;
  unsigned dimension_;
  std::unique_ptr<process::ChildProcess> process_;
};

}  // namespace grainstep::conformance
