/// @file A channel that keeps a copy of all that passes through it, for tests.
#pragma once

#include <vector>

#include "transport/channel.hpp"

namespace grainstep::transport {

/// Passes everything on to the channel that it decorates, which must outlive it.
class RecordingChannel final : public Channel {
 public:
  explicit RecordingChannel(Channel& inner) : inner_(inner) {}

  void send(std::span<const std::byte> message) override {
    sent_.emplace_back(message.begin(), message.end());
    inner_.send(message);
  }

  [[nodiscard]] bool receive(Bytes& message, Deadline deadline) override {
    const bool taken = inner_.receive(message, deadline);
    if (taken) {
      received_.push_back(message);
    }
    return taken;
  }

  [[nodiscard]] int wakeup() const override { return inner_.wakeup(); }

  [[nodiscard]] const std::vector<Bytes>& sent() const noexcept { return sent_; }
  [[nodiscard]] const std::vector<Bytes>& received() const noexcept { return received_; }

 private:
  Channel& inner_;
  std::vector<Bytes> sent_;
  std::vector<Bytes> received_;
};

}  // namespace grainstep::transport
