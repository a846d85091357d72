/// @file The lock step: forces one way, kinematics the other, window after window (docs/theory/step.md).
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "orchestrator/session/check_report.hpp"
#include "orchestrator/session/hub.hpp"
#include "orchestrator/session/listener.hpp"
#include "orchestrator/session/saving.hpp"
#include "orchestrator/session/step_observer.hpp"

namespace grainstep::orchestrator {

/// Runs from Start to the last report of both sides. Throws PeerError for silence, messages out of order or of the
/// wrong size, a velocity that does not belong to the motion; NumericalError for numbers that are not finite; what the
/// observer throws.
class LockStep {
 public:
  /// `listener`: where Forces and Kinematics are heard that take the short path; nullptr: they go through here, or here
  /// come copies of what went between the sides.
  LockStep(Hub& hub, StepObserver& observer, const wire::Start& start, double silence_s, Listener* listener = nullptr);
  LockStep(const LockStep&) = delete;
  LockStep& operator=(const LockStep&) = delete;
  ~LockStep();

  void run();

  /// Asked now and then while run() goes on, with the window whose Forces come next: whether both sides are to be asked
  /// for their states, which go to the observer as a checkpoint. Nothing where one of them cannot.
  void save_when(std::function<bool(std::uint64_t)> due) { save_due_ = std::move(due); }

  /// A run that goes on: the surface where it was at the end of the window before (m, nodes x dimension).
  void go_on_from(const std::vector<double>& surface);

  /// When the side that is waited for has been silent for too long.
  [[nodiscard]] transport::Deadline deadline() const;

  /// A message that comes after run() has thrown: a Report or a Snapshot still goes to the observer, the rest has
  /// become void.
  void late(Peer& peer, const wire::Frame& frame);

 private:
  void handle(Peer& peer, const wire::Frame& frame);
  void on_forces(wire::MessageChannel& from, const wire::Frame& frame);
  void on_kinematics(wire::MessageChannel& from, const wire::Frame& frame);
  /// Whether this came before what the other side has said first, or before the states that it is to wait for.
  [[nodiscard]] bool early(const Peer& peer, const wire::Frame& frame) const;
  [[nodiscard]] bool forces_wait() const { return saving_.holds_back() && !structure_owes_; }
  void listen();
  void take_what_came();           ///< on the short path
  [[nodiscard]] bool take_next();  ///< false: nothing is there whose turn it is
  void take(wire::MessageChannel& from, const wire::Frame& frame);
  void on_report(Peer& peer, const wire::Frame& frame);
  void on_snapshot(Peer& peer, const wire::Frame& frame);
  void save_if_due();
  void hand_over_checkpoint();
  void require_size(const Peer& peer, const char* what, std::uint64_t window, int found) const;
  void require_motion(const Peer& structure);
  [[nodiscard]] bool done() const;
  [[nodiscard]] const Peer& waited_for() const;

  /// What of the extra output has come from one side.
  struct Extra {
    std::uint64_t next_report = 0;
    std::uint64_t next_snapshot = 0;
    bool last_report = false;
    bool last_snapshot = false;
    ReportCheck check;
  };
  Extra& extra(const Peer& peer) { return peer.role == wire::IMPACTOR ? impactor_ : structure_; }

  Hub& hub_;
  StepObserver& observer_;
  wire::Start start_;
  double silence_s_;
  Listener* listener_;
  bool direct_;  // Forces and Kinematics that come here are copies
  unsigned dimension_;
  int values_;                    // nodes x dimension of the surface
  std::vector<double> position_;  // m, of the surface at the last exchange
  double size_ = 0.0;             // m, its largest coordinate
  std::uint64_t next_forces_;     // window of the Forces that come next
  Extra impactor_;
  Extra structure_;
  wire::Forces forces_;  // kept: their capacity is reused
  wire::Kinematics kinematics_;
  wire::Report report_;
  std::function<bool(std::uint64_t)> save_due_;
  Saving saving_;
  bool deaf_ = false;    // listening has failed
  bool structure_owes_;  // Forces were forwarded, the Kinematics they lead to are not here yet
};

}  // namespace grainstep::orchestrator
