/// @file Decides from a socket's connection events whether its one peer is there, or lost for good. Pure logic.
#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace grainstep::transport {

/// Feed it every event, in order. Strangers may connect to a bound socket and leave again; only the peer's own
/// connection counts, known by its file descriptor.
class PeerWatch {
 public:
  /// `event` and `value` as zmq_socket_monitor gives them.
  void see(std::uint16_t event, std::uint32_t value);

  /// A message came through this connection: whoever sent it is the peer.
  void heard_from(int connection);

  [[nodiscard]] bool knows_connection() const noexcept { return peer_ >= 0; }
  [[nodiscard]] bool connected() const noexcept { return connected_; }
  [[nodiscard]] bool lost() const noexcept { return lost_; }
  /// A connection was closed, refused or broken before its handshake was through.
  [[nodiscard]] bool attempt_failed() const noexcept { return attempt_failed_; }
  /// What the last failed attempt died of; empty: nobody was there.
  [[nodiscard]] const std::string& refusal() const noexcept { return refusal_; }

 private:
  void opened(int connection);
  void handshaken();
  void closed(int connection);

  std::set<int> open_;
  int peer_ = -1;  // unknown while several connections are open and none has spoken
  bool connected_ = false;
  bool lost_ = false;
  bool attempt_failed_ = false;
  std::string refusal_;
};

}  // namespace grainstep::transport
