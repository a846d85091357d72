/// @file A channel that mistreats chosen messages, for tests of what notices.
#pragma once

#include <cstdint>
#include <optional>

#include "transport/channel.hpp"

namespace grainstep::transport {

/// What happens to the `message`-th message sent through the channel (from 1).
struct Fault {
  enum class Kind {
    drop,       ///< never arrives
    duplicate,  ///< arrives twice
    delay,      ///< arrives after the message behind it
    truncate,   ///< loses its bytes from `position` on
    flip_bit    ///< the bit at `position` (counted from the first byte's lowest bit) is inverted
  };
  Kind kind = Kind::drop;
  std::uint64_t message = 1;
  std::size_t position = 0;
};

/// Passes everything on to the channel that it decorates, which must outlive it.
class FaultyChannel final : public Channel {
 public:
  FaultyChannel(Channel& inner, Fault fault) : inner_(inner), fault_(fault) {}

  void send(std::span<const std::byte> message) override;
  [[nodiscard]] bool receive(Bytes& message, Deadline deadline) override { return inner_.receive(message, deadline); }
  [[nodiscard]] int wakeup() const override { return inner_.wakeup(); }

 private:
  void mistreat(std::span<const std::byte> message);

  Channel& inner_;
  Fault fault_;
  std::uint64_t sent_ = 0;
  std::optional<Bytes> held_back_;
};

}  // namespace grainstep::transport
