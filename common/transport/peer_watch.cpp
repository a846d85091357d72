#include "transport/peer_watch.hpp"

#include <zmq.h>

namespace grainstep::transport {

void PeerWatch::see(std::uint16_t event, std::uint32_t value) {
  switch (event) {
    case ZMQ_EVENT_ACCEPTED:
    case ZMQ_EVENT_CONNECTED:
      return opened(static_cast<int>(value));
    case ZMQ_EVENT_HANDSHAKE_SUCCEEDED:
      return handshaken();
    case ZMQ_EVENT_HANDSHAKE_FAILED_AUTH:
      refusal_ = "it refused us (status " + std::to_string(value) + "): wrong key, or it has its peer already";
      break;
    case ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL:
    case ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL:
      if (refusal_.empty()) {
        refusal_ = "it ended the handshake: do both sides use CURVE, and keys that belong together?";
      }
      break;
    case ZMQ_EVENT_DISCONNECTED:
      return closed(static_cast<int>(value));
    default:  // closed or retried: nobody listens there
      break;
  }
  attempt_failed_ = true;
}

void PeerWatch::opened(int connection) { open_.insert(connection); }

void PeerWatch::handshaken() {
  if (!connected_ && open_.size() == 1) {
    peer_ = *open_.begin();
  }
  connected_ = true;
}

void PeerWatch::heard_from(int connection) {
  peer_ = connection;
  connected_ = true;
  lost_ = lost_ || !open_.contains(connection);
}

void PeerWatch::closed(int connection) {
  open_.erase(connection);
  attempt_failed_ = true;
  if (connected_ && (peer_ == connection || (peer_ < 0 && open_.empty()))) {
    lost_ = true;
  }
}

}  // namespace grainstep::transport
