/// @file Both conversations at once: takes messages as they come and hands them to whoever drives the phase.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "base/error.hpp"
#include "orchestrator/session/event_loop.hpp"
#include "orchestrator/session/peer.hpp"

namespace grainstep::orchestrator {

struct Deadlines {
  double connect_s = 120.0;  ///< until both sides have said Hello; a process that ends before is noticed by its end
  double step_s = 300.0;     ///< of silence from the side that is waited for
  double stop_s = 5.0;       ///< for the answers to Stop after a failure
};

/// Called between messages and waits; throws PeerError when a participant's process has ended before its time.
using Watchdog = std::function<void()>;

class Hub {
 public:
  /// Channels outlive the hub. `loop` may have other sources; their actions may throw through every wait.
  Hub(transport::Channel& impactor, transport::Channel& structure, EventLoop& loop, Watchdog watchdog = {});

  [[nodiscard]] Peer& impactor() { return impactor_; }
  [[nodiscard]] Peer& structure() { return structure_; }
  [[nodiscard]] Peer& other(const Peer& peer) { return &peer == &impactor_ ? structure_ : impactor_; }

  [[nodiscard]] std::chrono::duration<double> standstill() const { return loop_.standstill(); }

  using Handler = std::function<void(Peer&, const wire::Frame&)>;
  using Done = std::function<bool()>;
  using Until = std::function<transport::Deadline()>;

  /// Called after a message was received and before anything is made of it, and before last words: what takes another
  /// way than the channels is to be heard no later than what came after it on a channel. Empty: nothing does.
  using Overhear = std::function<void()>;
  void overhear(Overhear overhear) { overhear_ = std::move(overhear); }

  [[nodiscard]] EventLoop& loop() { return loop_; }

  /// The moment that many seconds from now.
  [[nodiscard]] static Until within(double seconds);

  /// A handler may put a message back (MessageChannel): it gets it again after the other side's next one. Hands every
  /// message to `handler` until `done` (true) or until the deadline, which is asked for anew before every
  /// wait, has passed (false). An Error of a participant becomes the exception it stands for.
  bool run(const Handler& handler, const Done& done, const Until& deadline);

  template <wire::Body Message>
  void send(Peer& peer, const Message& message) {
    try {
      peer.messages.send(message);
    } catch (const PeerError& error) {
      hear_last_words(error.peer(), [](Peer&, const wire::Frame&) {});
      throw;
    }
  }

 private:
  bool run_until(const Handler& handler, const Done& done, const Until& deadline);

  /// A participant that fails says why and goes; its going may be noticed first, when something is sent to it. What it
  /// said before goes to `handler`, what its Error stands for is thrown, if there is one.
  void hear_last_words(const std::string& peer, const Handler& handler);

  bool take_one(Peer& peer, const Handler& handler);

  Peer impactor_;
  Peer structure_;
  EventLoop& loop_;
  Watchdog watchdog_;
  Overhear overhear_;
};

}  // namespace grainstep::orchestrator
