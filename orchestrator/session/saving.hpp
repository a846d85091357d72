/// @file Asks both sides for their states and puts them together, while the lock step goes on (proto/README.md,
/// "State").
///
/// The impactor is asked, and says in the Forces of its next window that it will be that one: so both sides save the
/// same window without having to stop. Until both states are here, the lock step takes no Forces of a later window, so
/// that whoever looks on has seen everything up to that window and nothing of the next.
#pragma once

#include <optional>

#include "orchestrator/session/checkpoint.hpp"
#include "orchestrator/session/hub.hpp"
#include "wire/state_parts.hpp"

namespace grainstep::orchestrator {

class Saving {
 public:
  explicit Saving(Hub& hub) : hub_(hub) {}

  /// Whether both sides say that they can.
  [[nodiscard]] bool possible() const;

  /// Nothing if asked already, and not answered yet.
  void ask();

  /// Forces said that this window is to be saved. PeerError where nobody asked for it.
  void begin(std::uint64_t window, std::vector<double> surface);

  /// A state may come before the Forces that ask for it have been heard.
  [[nodiscard]] bool expected() const { return asked_ && !holds_back(); }
  [[nodiscard]] bool holds_back() const { return impactor_.has_value(); }
  [[nodiscard]] std::uint64_t window() const { return window_; }
  /// Whose state is not complete yet, of a window that has begun to be saved.
  [[nodiscard]] const Peer* owing() const;

  /// State and Saved. False for other messages. PeerError for what was not asked for, or is damaged.
  [[nodiscard]] bool take(Peer& peer, const wire::Frame& frame);

  /// Both states, once.
  [[nodiscard]] std::optional<Checkpoint> completed();

 private:
  struct Side {
    wire::StateParts parts;
    bool saved = false;
  };
  std::optional<Side>& side(const Peer& peer) { return peer.role == wire::IMPACTOR ? impactor_ : structure_; }

  Hub& hub_;
  bool asked_ = false;
  std::uint64_t window_ = 0;
  std::vector<double> surface_;
  std::optional<Side> impactor_, structure_;
};

}  // namespace grainstep::orchestrator
