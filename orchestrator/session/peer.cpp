#include "orchestrator/session/peer.hpp"

#include "base/error.hpp"

namespace grainstep::orchestrator {

void throw_error_of(const Peer& peer, const wire::Frame& frame) {
  wire::Error error;
  peer.messages.take(frame, error);
  if (error.kind() == wire::Error::BAD_INPUT) {
    throw InputError(peer.name() + ": " + error.text());
  }
  if (error.kind() == wire::Error::NUMERICAL) {
    throw NumericalError(peer.name() + ": " + error.text());
  }
  throw PeerError(peer.name(), error.text());
}

}  // namespace grainstep::orchestrator
