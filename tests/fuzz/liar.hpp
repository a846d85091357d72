/// @file A peer that says what a script says, whatever it hears.
#pragma once

#include "framing.hpp"

namespace grainstep::fuzz {

/// A file descriptor that is always readable: whoever polls a channel of ours need not wait.
[[nodiscard]] int always_readable();

/// Its end of a channel, in the same thread as the code under test. It never waits: what is not said at once is not
/// said before the deadline.
class Liar final : public transport::Channel {
 public:
  /// `name`: of the liar, in PeerErrors. `script` outlives the channel.
  Liar(const Script& script, std::string name) : script_(script), name_(std::move(name)) {}

  /// What it hears must be a good message. Our own errors of the kind INTERNAL are a finding: whoever lies to a
  /// participant is to be told what is wrong with his message.
  void send(std::span<const std::byte> message) override;

  [[nodiscard]] bool receive(transport::Bytes& message, transport::Deadline deadline) override;

  [[nodiscard]] int wakeup() const override { return always_readable(); }

 private:
  const Script& script_;
  std::string name_;
  Framing framing_;
  wire::Decoder heard_as_{"the code under test"};
  std::uint32_t heard_ = 0;
  int said_ = 0;
  bool gone_ = false;
};

}  // namespace grainstep::fuzz
