#include "wire/message_channel.hpp"

#include "base/error.hpp"

namespace grainstep::wire {

const Frame* MessageChannel::receive(transport::Deadline deadline) {
  if (put_back_) {
    put_back_ = false;
    return &frame_;
  }
  if (!channel_.receive(received_, deadline)) {
    return nullptr;
  }
  frame_ = decoder_.decode(received_);
  return &frame_;
}

void MessageChannel::refuse(const std::string& expected, const Frame& frame) const {
  throw PeerError(peer_,
                  "message " + std::to_string(frame.sequence) + ": expected " + expected + ", got " + describe(frame));
}

void MessageChannel::refuse_damaged(const Frame& frame) const {
  throw PeerError(peer_, "message " + std::to_string(frame.sequence) + ": the bytes of this " + kind_name(frame.kind) +
                             " are not a valid message of its kind");
}

}  // namespace grainstep::wire
