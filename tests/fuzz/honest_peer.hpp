/// @file The side that does not lie: answers whatever it is told as the protocol wants it, and computes nothing.
#pragma once

#include <deque>

#include "grainstep/wire.pb.h"
#include "transport/channel.hpp"
#include "wire/codec.hpp"

namespace grainstep::fuzz {

/// A participant of either role in the thread of the session that talks to it.
class HonestPeer final : public transport::Channel {
 public:
  HonestPeer(wire::Role role, unsigned dimension);

  void send(std::span<const std::byte> message) override;
  [[nodiscard]] bool receive(transport::Bytes& message, transport::Deadline deadline) override;
  [[nodiscard]] int wakeup() const override;

 private:
  template <class Message>
  void say(const Message& message);
  void prepare(const wire::Setup& setup);
  void start(const wire::Start& start);
  void push(std::uint64_t window);
  void move(std::uint64_t window);
  void report(std::uint64_t window);

  wire::Role role_;
  unsigned dimension_;
  wire::Surface surface_;
  wire::Start start_;
  wire::Decoder decoder_{"orchestrator"};
  wire::Encoder encoder_;
  std::deque<transport::Bytes> outbox_;
};

/// A flat square, or a line of two segments, at rest.
[[nodiscard]] wire::Surface flat_surface(unsigned dimension);

}  // namespace grainstep::fuzz
