#include "orchestrator/session/lock_step.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "base/error.hpp"
#include "ledger/message_numbers.hpp"
#include "participant/schedule.hpp"
#include "wire/finite.hpp"

namespace grainstep::orchestrator {
namespace {

void require_finite(const Peer& peer, const std::string& what, std::uint64_t window,
                    const google::protobuf::RepeatedField<double>& values) {
  wire::require_finite(peer.name() + ": " + what, window, values,
                       "The computation has become unstable: try smaller steps.");
}

}  // namespace

LockStep::LockStep(Hub& hub, StepObserver& observer, const wire::Start& start, double silence_s, Listener* listener)
    : hub_(hub),
      observer_(observer),
      start_(start),
      silence_s_(silence_s),
      listener_(listener),
      direct_(start.has_direct()),
      dimension_(std::max(1U, hub.structure().ready.surface().dimension())),
      values_(hub.structure().ready.surface().position_size()),
      position_(hub.structure().ready.surface().position().begin(), hub.structure().ready.surface().position().end()),
      next_forces_(start.first_window()),
      impactor_{.check = ReportCheck(dimension_)},
      structure_{.check = ReportCheck(dimension_)},
      saving_(hub),
      structure_owes_(start.first_window() > 0) {
  for (const double x : position_) size_ = std::max(size_, std::abs(x));
  for (Extra* side : {&impactor_, &structure_}) {
    const std::uint64_t first = start.first_window();
    const participant::Due due = participant::due_at(start, first);
    side->next_report = due.report ? first : participant::next_due(start, first, &participant::Due::report);
    side->next_snapshot = due.snapshot ? first : participant::next_due(start, first, &participant::Due::snapshot);
    side->last_snapshot = side->next_snapshot > start.windows();
  }
  if (listener_) hub_.overhear([this] { listen(); });
}

LockStep::~LockStep() { hub_.overhear({}); }

void LockStep::run() {
  std::optional<Ticking> ticking;
  if (listener_) ticking.emplace(hub_.loop(), [this] { listen(); });
  const auto now = transport::Clock::now();
  hub_.impactor().heard = now;
  hub_.structure().heard = now;
  if (!saving_.possible()) save_due_ = {};
  const auto until = [this] {
    observer_.idle();
    save_if_due();
    return deadline();
  };
  if (!hub_.run([this](Peer& peer, const wire::Frame& frame) { handle(peer, frame); }, [this] { return done(); },
                until)) {
    throw PeerError(waited_for().name(), "said nothing for " + std::to_string(static_cast<int>(silence_s_)) +
                                             " s at window " + std::to_string(next_forces_) + " of " +
                                             std::to_string(start_.windows()) +
                                             ". If its steps take that long, raise --step-deadline.");
  }
}

transport::Deadline LockStep::deadline() const {
  return waited_for().heard +
         std::chrono::duration_cast<transport::Clock::duration>(std::chrono::duration<double>(silence_s_));
}

const Peer& LockStep::waited_for() const {
  if (forces_wait()) return *saving_.owing();
  if (structure_owes_) {
    return hub_.structure();
  }
  if (next_forces_ <= start_.windows()) {
    return hub_.impactor();
  }
  return impactor_.last_report && impactor_.last_snapshot ? hub_.structure() : hub_.impactor();
}

bool LockStep::done() const {
  return next_forces_ > start_.windows() && impactor_.last_report && impactor_.last_snapshot &&
         structure_.last_report && structure_.last_snapshot;
}

// The sides wait for each other, and not for us: what they say here may overtake what went between them.
bool LockStep::early(const Peer& peer, const wire::Frame& frame) const {
  const std::uint64_t window = wire::window_of(frame).value_or(0);
  const auto kind = frame.kind;
  if (kind == wire::Envelope::kForces && forces_wait()) return true;
  if (kind == wire::Envelope::kForces) return direct_ && structure_owes_ && window == next_forces_;
  if (kind == wire::Envelope::kKinematics) return direct_ && !structure_owes_ && window == next_forces_ + 1;
  if (kind == wire::Envelope::kState || kind == wire::Envelope::kSaved) return saving_.expected();
  const bool report = kind == wire::Envelope::kReport;
  const Extra& side = peer.role == wire::IMPACTOR ? impactor_ : structure_;
  const bool next =
      (report && window == side.next_report) || (kind == wire::Envelope::kSnapshot && window == side.next_snapshot);
  if (!next) return false;
  if (saving_.holds_back() && window > saving_.window()) return true;
  return (direct_ || listener_) && peer.role == wire::STRUCTURE && window >= next_forces_;
}

void LockStep::handle(Peer& peer, const wire::Frame& frame) {
  if (early(peer, frame)) return peer.messages.put_back();
  if (!listener_ && frame.kind == wire::Envelope::kForces && peer.role == wire::IMPACTOR) {
    on_forces(peer.messages, frame);
  } else if (!listener_ && frame.kind == wire::Envelope::kKinematics && peer.role == wire::STRUCTURE) {
    on_kinematics(peer.messages, frame);
  } else if (frame.kind == wire::Envelope::kReport) {
    on_report(peer, frame);
  } else if (frame.kind == wire::Envelope::kSnapshot) {
    on_snapshot(peer, frame);
  } else if (saving_.take(peer, frame)) {
    hand_over_checkpoint();
  } else {
    peer.messages.refuse(peer.role == wire::IMPACTOR ? "Forces, Report or Snapshot" : "Kinematics, Report or Snapshot",
                         frame);
  }
}

void LockStep::late(Peer& peer, const wire::Frame& frame) {
  // Rows of windows before the failure must not depend on whose copies were quicker.
  const bool data = frame.kind == wire::Envelope::kForces || frame.kind == wire::Envelope::kKinematics;
  if (direct_ && data && !early(peer, frame)) return handle(peer, frame);
  // On the short path the sides may be ahead of what was heard before the failure.
  if (wire::window_of(frame).value_or(0) >= next_forces_) return;
  if (frame.kind == wire::Envelope::kReport) {
    on_report(peer, frame);
  } else if (frame.kind == wire::Envelope::kSnapshot) {
    on_snapshot(peer, frame);
  }
}

void LockStep::require_size(const Peer& peer, const char* what, std::uint64_t window, int found) const {
  if (found != values_) {
    throw PeerError(peer.name(), std::string(what) + " of window " + std::to_string(window) + " holds " +
                                     std::to_string(found) + " values, the surface has " + std::to_string(values_));
  }
}

// What has failed once is not asked again: the sides are still to be stopped, and heard.
void LockStep::listen() {
  if (deaf_) return;
  try {
    take_what_came();
  } catch (...) {
    deaf_ = true;
    throw;
  }
}

void LockStep::take_what_came() {
  listener_->close_door();
  while (take_next()) {
  }
}

void LockStep::save_if_due() {
  if (!save_due_ || next_forces_ > start_.windows()) return;
  if (save_due_(next_forces_)) saving_.ask();
}

void LockStep::hand_over_checkpoint() {
  if (auto checkpoint = saving_.completed()) observer_.checkpoint(std::move(*checkpoint));
}

void LockStep::go_on_from(const std::vector<double>& surface) {
  if (surface.size() != position_.size()) {
    throw PeerError(hub_.structure().name(), "has a surface of " + std::to_string(position_.size()) +
                                                 " coordinates, the checkpoint one of " +
                                                 std::to_string(surface.size()));
  }
  position_ = surface;
}

bool LockStep::take_next() {
  if (forces_wait()) return false;
  const transport::Deadline now = transport::Clock::now();
  // As on the other path: what the impactor reports of a window comes before its Forces of the next.
  if (!structure_owes_ && (impactor_.next_report < next_forces_ || impactor_.next_snapshot < next_forces_))
    return false;
  Listener::Way& turn = structure_owes_ ? listener_->kinematics() : listener_->forces();
  Listener::Way& other = structure_owes_ ? listener_->forces() : listener_->kinematics();
  // Looked at before the one whose turn it is: what is there although that one has not spoken did not wait for it.
  const bool out_of_turn = other.channel.pending();
  if (const wire::Frame* frame = turn.messages.receive(now)) {
    take(turn.messages, *frame);
    return true;
  }
  if (!out_of_turn) return false;
  if (const wire::Frame* frame = other.messages.receive(now)) take(other.messages, *frame);
  return true;
}

void LockStep::take(wire::MessageChannel& from, const wire::Frame& frame) {
  if (&from == &listener_->forces().messages) {
    on_forces(from, frame);
  } else {
    on_kinematics(from, frame);
  }
}

void LockStep::on_forces(wire::MessageChannel& from, const wire::Frame& frame) {
  Peer& impactor = hub_.impactor();
  if (structure_owes_ || next_forces_ > start_.windows() || wire::window_of(frame) != next_forces_) {
    from.refuse(structure_owes_
                    ? "no Forces before the Kinematics of window " + std::to_string(next_forces_) + " were sent"
                    : "Forces of window " + std::to_string(next_forces_),
                frame);
  }
  if (!listener_ && !direct_) hub_.structure().messages.forward(frame);
  hub_.structure().heard = transport::Clock::now();
  impactor.under_way = true;
  const std::uint64_t window = next_forces_++;
  structure_owes_ = window < start_.windows();
  from.take(frame, forces_, window);
  require_size(impactor, "Forces", window, forces_.impulse_size());
  require_finite(impactor, "Forces", window, forces_.impulse());
  if (forces_.save()) saving_.begin(window, position_);
  observer_.forces(forces_);
}

void LockStep::on_kinematics(wire::MessageChannel& from, const wire::Frame& frame) {
  Peer& structure = hub_.structure();
  if (!structure_owes_ || wire::window_of(frame) != next_forces_) {
    from.refuse(structure_owes_ ? "Kinematics of window " + std::to_string(next_forces_)
                                : std::string("no Kinematics before the next Forces were sent"),
                frame);
  }
  if (!listener_ && !direct_) hub_.impactor().messages.forward(frame);
  hub_.impactor().heard = transport::Clock::now();
  structure_owes_ = false;
  structure.under_way = true;
  from.take(frame, kinematics_, next_forces_);
  require_size(structure, "position in Kinematics", next_forces_, kinematics_.position_size());
  require_size(structure, "velocity in Kinematics", next_forces_, kinematics_.velocity_size());
  require_finite(structure, "position in Kinematics", next_forces_, kinematics_.position());
  require_finite(structure, "velocity in Kinematics", next_forces_, kinematics_.velocity());
  require_motion(structure);
  if (observer_.follows_surface()) observer_.kinematics(kinematics_);
}

// The impactor moves the surface by the one and computes contact with the other: no ledger would see that they differ.
void LockStep::require_motion(const Peer& structure) {
  constexpr double of_the_way = 1e-6;
  constexpr double of_the_size = 1e-12;  // round-off of positions, summed up over a window's steps
  for (int i = 0; i < values_; ++i) {
    const double way = kinematics_.position(i) - position_[static_cast<std::size_t>(i)];
    const double told = kinematics_.velocity(i) * start_.window();
    if (std::abs(way - told) > of_the_way * std::abs(told) + of_the_size * size_) {
      std::ostringstream text;
      const int n = static_cast<int>(dimension_);
      text << "Kinematics of window " << next_forces_ << ": coordinate " << i % n + 1 << " of node " << i / n
           << " moved by " << way << " m, but the velocity sent with it times the window makes " << told
           << " m. Send the mean velocity of the window that has ended, and its position at the end.";
      throw PeerError(structure.name(), text.str());
    }
  }
  position_.assign(kinematics_.position().begin(), kinematics_.position().end());
}

void LockStep::on_report(Peer& peer, const wire::Frame& frame) {
  Extra& side = extra(peer);
  if (side.last_report) {
    peer.messages.refuse("no further Report", frame);
  }
  peer.messages.take(frame, report_, side.next_report);
  if (const auto found = ledger::first_not_finite(report_)) {
    throw NumericalError(peer.name() + ": report of window " + std::to_string(report_.window()) + ": " + *found +
                         ". The computation has become unstable: try smaller steps.");
  }
  side.check.report(peer, report_);
  side.last_report = side.next_report == start_.windows();
  side.next_report = participant::next_due(start_, side.next_report, &participant::Due::report);
  peer.timing = report_.timing();
  observer_.report(peer.role, report_);
}

void LockStep::on_snapshot(Peer& peer, const wire::Frame& frame) {
  Extra& side = extra(peer);
  if (side.last_snapshot) {
    peer.messages.refuse("no further Snapshot", frame);
  }
  wire::Snapshot snapshot;
  peer.messages.take(frame, snapshot, side.next_snapshot);
  side.check.snapshot(peer, snapshot);
  side.next_snapshot = participant::next_due(start_, side.next_snapshot, &participant::Due::snapshot);
  side.last_snapshot = side.next_snapshot > start_.windows();
  observer_.snapshot(peer.role, std::move(snapshot));
}

}  // namespace grainstep::orchestrator
