#include "liar.hpp"

#include <sys/eventfd.h>

#include "base/assert.hpp"
#include "base/error.hpp"
#include "statistics.hpp"

namespace grainstep::fuzz {

int always_readable() {
  static const int event = ::eventfd(1, EFD_NONBLOCK | EFD_CLOEXEC);
  return event;
}

void Liar::send(std::span<const std::byte> message) {
  if (gone_) throw PeerError(name_, "closed its channel");
  const wire::Frame frame = heard_as_.decode(message);
  wire::Error error;
  if (wire::parse(frame, error)) {
    GS_ASSERT(error.kind() != wire::Error::INTERNAL, "ends with an error without a name: " + error.text());
  }
  ++heard_;
}

bool Liar::receive(transport::Bytes& message, transport::Deadline /*deadline*/) {
  if (said_ < script_.said_size()) {
    const Said& next = script_.said(said_);
    if (next.after() > heard_) return false;
    ++said_;
    ++statistics().messages;
    message = framing_.frame_of(next);
    return true;
  }
  gone_ = gone_ || script_.hangs_up();
  if (gone_) throw PeerError(name_, "closed its channel");
  return false;
}

}  // namespace grainstep::fuzz
