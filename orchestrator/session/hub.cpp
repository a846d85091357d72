#include "orchestrator/session/hub.hpp"

namespace grainstep::orchestrator {
namespace {

// For all last words together: what was said before the loss is here, or almost; a peer that is lost to us for what it
// said may well go on for ever.
constexpr std::chrono::milliseconds patience_for_last_words{1000};

}  // namespace

Hub::Hub(transport::Channel& impactor, transport::Channel& structure, EventLoop& loop, Watchdog watchdog)
    : impactor_(wire::IMPACTOR, impactor),
      structure_(wire::STRUCTURE, structure),
      loop_(loop),
      watchdog_(std::move(watchdog)) {
  loop_.add(impactor);
  loop_.add(structure);
}

bool Hub::take_one(Peer& peer, const Handler& handler) {
  const wire::Frame* frame = peer.messages.receive(transport::Clock::now());
  if (frame == nullptr) {
    return false;
  }
  peer.heard = transport::Clock::now();
  if (overhear_) overhear_();
  if (frame->kind == wire::Envelope::kError) {
    peer.finished = true;  // an Error is a participant's last message
    throw_error_of(peer, *frame);
  }
  handler(peer, *frame);
  return !peer.messages.is_put_back();  // its turn comes with a message of the other side's
}

void Hub::hear_last_words(const std::string& peer, const Handler& handler) {
  Peer& lost = peer == impactor_.name() ? impactor_ : structure_;
  try {
    if (overhear_) overhear_();
  } catch (const PeerError&) {  // the one that is known already, or what follows from it
  }
  const transport::Deadline end = transport::in(patience_for_last_words);
  while (!lost.finished && transport::Clock::now() < end) {
    const wire::Frame* frame = nullptr;
    try {
      frame = lost.messages.receive(transport::in(std::chrono::milliseconds(100)));
    } catch (const PeerError&) {  // nothing more, or nothing that can be read
    }
    if (frame == nullptr) {
      return;
    }
    if (frame->kind == wire::Envelope::kError) {
      lost.finished = true;
      throw_error_of(lost, *frame);
    }
    try {
      handler(lost, *frame);
      lost.messages.drop();
    } catch (const PeerError&) {  // it leads to the lost one, or out of turn because of what could not be sent
    }
  }
}

Hub::Until Hub::within(double seconds) {
  return [deadline = transport::in(std::chrono::duration<double>(seconds))] { return deadline; };
}

bool Hub::run(const Handler& handler, const Done& done, const Until& deadline) {
  loop_.wake();
  try {
    return run_until(handler, done, deadline);
  } catch (const PeerError& error) {
    hear_last_words(error.peer(), handler);
    throw;
  }
}

bool Hub::run_until(const Handler& handler, const Done& done, const Until& deadline) {
  while (true) {
    // A channel's wake-up is an edge, and sending may swallow it: wait only after both channels said "nothing" in turn.
    bool again = true;
    while (again) {
      again = false;
      for (Peer* peer : {&impactor_, &structure_}) {
        // A finished peer has closed its end: to ask it for more would be taken for a loss.
        again = (!peer->finished && take_one(*peer, handler)) || again;
        if (done()) {
          return true;
        }
      }
    }
    if (watchdog_) {
      watchdog_();
    }
    const transport::Deadline until = deadline();
    if (transport::Clock::now() >= until) {
      return false;
    }
    loop_.wait(until);
  }
}

}  // namespace grainstep::orchestrator
