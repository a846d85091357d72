/// @file One end of the short path (shared_path.hpp) as a channel.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "transport/channel.hpp"
#include "transport/shared_path.hpp"

namespace grainstep::transport {

/// A channel that cannot notice a loss by itself: whoever waits is called back every few milliseconds and looks.
class SharedChannel final : public Channel {
 public:
  /// Called while send() or receive() wait; what it throws goes through them.
  using WhileWaiting = std::function<void()>;

  /// A participant's end: writes `out`, reads the other way. `peer`: the other participant, named in PeerErrors.
  SharedChannel(const SharedPath& path, SharedPath::Way out, std::string peer, WhileWaiting look);

  /// Who listens to one way, and never waits. `peer`: who writes there.
  SharedChannel(const SharedPath& path, SharedPath::Way heard, std::string peer);

  /// Waits while the ring is full.
  void send(std::span<const std::byte> message) override;
  [[nodiscard]] bool receive(Bytes& message, Deadline deadline) override;

  /// A message will be sent within microseconds: a peer that sleeps may wake up for it.
  void knock();

  /// Whether receive() would find a message now.
  [[nodiscard]] bool pending() const { return in_.pending(); }

 private:
  [[nodiscard]] bool take(Bytes& message);
  [[nodiscard]] bool spin(Bytes& message);
  [[nodiscard]] bool worth_a_spin();

  std::optional<SharedRing> out_;
  SharedRing in_;
  SharedRing::Reader reader_;
  std::string peer_;
  WhileWaiting look_;
  bool may_spin_;
  unsigned misses_ = 0;     ///< spins in a row that were in vain
  unsigned sleep_for_ = 0;  ///< waits before the next spin is tried
};

}  // namespace grainstep::transport
