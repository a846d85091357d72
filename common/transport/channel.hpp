/// @file A channel carries whole messages of bytes between exactly two peers, in order, without loss or duplication
/// while both live. Implementations: ZeroMQ (zmq_channel.hpp), in-process (in_process_channel.hpp); decorators for
/// tests (faulty_channel.hpp, recording_channel.hpp). One contract suite runs over all of them.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

namespace grainstep::transport {

using Clock = std::chrono::steady_clock;
using Deadline = Clock::time_point;
using Bytes = std::vector<std::byte>;

[[nodiscard]] inline Deadline in(std::chrono::duration<double> seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(seconds);
}

/// Owned and used by one thread at a time; the two ends may live in two threads or processes.
class Channel {
 public:
  Channel() = default;
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  Channel(Channel&&) = delete;
  Channel& operator=(Channel&&) = delete;
  virtual ~Channel() = default;

  /// Queues one message. Does not wait for the peer to read it. Throws PeerError when the peer is known to be lost.
  virtual void send(std::span<const std::byte> message) = 0;

  /// Takes the next message into `message` (its capacity is reused) and returns true; false at the deadline.
  /// Throws PeerError as soon as the peer is lost and every message that it sent has been taken.
  [[nodiscard]] virtual bool receive(Bytes& message, Deadline deadline) = 0;

  /// A file descriptor that becomes readable when receive() may have something to say, for use in poll();
  /// edge-triggered like ZMQ_FD: after a wake-up, and after a send(), call receive() until it returns false. -1: none.
  [[nodiscard]] virtual int wakeup() const { return -1; }
};

}  // namespace grainstep::transport
