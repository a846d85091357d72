#include "honest_peer.hpp"

#include "base/assert.hpp"
#include "liar.hpp"
#include "participant/hello.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fuzz {

wire::Surface flat_surface(unsigned dimension) {
  wire::Surface out;
  out.set_dimension(dimension);
  const auto node = [&](double x1, double x2, double x3) {
    for (const double x : {x1, x2}) out.add_position(x);
    if (dimension == 3) out.add_position(x3);
    for (unsigned c = 0; c < dimension; ++c) out.add_velocity(0.0);
  };
  if (dimension == 2) {
    for (const double x1 : {0.0, 0.5, 1.0}) node(x1, 0.0, 0.0);
    for (const unsigned n : {0U, 1U, 1U, 2U}) out.add_facet(n);
    return out;
  }
  for (const double x1 : {0.0, 1.0}) {
    for (const double x3 : {0.0, 1.0}) node(x1, 0.0, x3);
  }
  for (const unsigned n : {0U, 1U, 2U, 1U, 3U, 2U}) out.add_facet(n);
  return out;
}

HonestPeer::HonestPeer(wire::Role role, unsigned dimension) : role_(role), dimension_(dimension) {
  wire::Hello hello = participant::hello(role, "honest", "1", {2, 3});
  for (const char* word : {"external", "plane_strain", "axisymmetric"}) hello.add_capabilities(word);
  say(hello);
}

int HonestPeer::wakeup() const { return always_readable(); }

template <class Message>
void HonestPeer::say(const Message& message) {
  const auto frame = encoder_.encode(message);
  outbox_.emplace_back(frame.begin(), frame.end());
}

bool HonestPeer::receive(transport::Bytes& message, transport::Deadline /*deadline*/) {
  if (outbox_.empty()) return false;
  message.swap(outbox_.front());
  outbox_.pop_front();
  return true;
}

void HonestPeer::send(std::span<const std::byte> message) {
  const wire::Frame frame = decoder_.decode(message);
  if (wire::Setup setup; wire::parse(frame, setup)) return prepare(setup);
  if (wire::Start started; wire::parse(frame, started)) return start(started);
  if (frame.kind == wire::Envelope::kStop) return say(wire::Finished());
  const auto window = wire::window_of(frame);
  if (frame.kind == wire::Envelope::kForces) return move(*window);
  if (frame.kind == wire::Envelope::kKinematics) return push(*window);
}

void HonestPeer::prepare(const wire::Setup& setup) {
  surface_ = role_ == wire::STRUCTURE ? flat_surface(dimension_) : setup.impactor().surface();
  wire::Ready ready;
  ready.set_scene_hash(setup.scene_hash());
  ready.set_stable_step(1e-3);
  ready.set_preferred_step(1e-3);
  ready.set_mass(1.0);
  ready.set_ledger(wire::FULL);
  if (role_ == wire::STRUCTURE) *ready.mutable_surface() = surface_;
  say(ready);
}

void HonestPeer::start(const wire::Start& start) {
  start_ = start;
  if (role_ == wire::IMPACTOR) push(start.first_window());
}

void HonestPeer::push(std::uint64_t window) {
  wire::Forces forces;
  forces.set_window(window);
  for (int i = 0; i < surface_.position_size(); ++i) forces.add_impulse(0.0);
  say(forces);
  report(window);
}

void HonestPeer::move(std::uint64_t window) {
  if (window < start_.windows()) {
    wire::Kinematics next;
    next.set_window(window + 1);
    *next.mutable_position() = surface_.position();
    for (int i = 0; i < surface_.position_size(); ++i) next.add_velocity(0.0);
    say(next);
  }
  report(window);
}

void HonestPeer::report(std::uint64_t window) {
  const participant::Due due = participant::due_at(start_, window);
  if (due.report) {
    wire::Report report;
    report.set_window(window);
    for (unsigned c = 0; c < dimension_; ++c) {
      report.mutable_momentum()->add_linear(0.0);
      report.mutable_momentum()->add_interface_impulse(0.0);
      report.mutable_momentum()->add_support_impulse(0.0);
    }
    say(report);
  }
  if (due.snapshot) {
    wire::Snapshot snapshot;
    snapshot.set_window(window);
    say(snapshot);
  }
}

}  // namespace grainstep::fuzz
