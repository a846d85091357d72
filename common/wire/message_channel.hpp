/// @file A channel that speaks messages: codec and channel together, and errors for messages out of order.
#pragma once

#include <string>

#include "transport/channel.hpp"
#include "wire/codec.hpp"

namespace grainstep::wire {

/// One end of a conversation. Same rules of ownership and threads as the Channel below it, which must outlive it.
/// Every function may throw PeerError: the peer is lost, or what it sent is damaged or out of order.
class MessageChannel {
 public:
  /// `peer`: the other side's name in errors.
  MessageChannel(transport::Channel& channel, std::string peer)
      : channel_(channel), peer_(std::move(peer)), decoder_(peer_) {}

  template <Body Message>
  void send(const Message& message) {
    channel_.send(encoder_.encode(message));
  }

  /// Passes a message of another conversation on, without parsing or serialising it.
  void forward(const Frame& frame) { channel_.send(encoder_.forward(frame.payload)); }

  /// The next message, valid until the next call; nullptr at the deadline.
  [[nodiscard]] const Frame* receive(transport::Deadline deadline);

  /// What receive() gave last will be given once more: it has come before its turn.
  void put_back() noexcept { put_back_ = true; }
  [[nodiscard]] bool is_put_back() const noexcept { return put_back_; }
  /// It is not wanted again after all.
  void drop() noexcept { put_back_ = false; }

  /// Fills `message` from `frame`. PeerError "expected Ready, got ..." when the frame is of another kind.
  template <Body Message>
  void take(const Frame& frame, Message& message) const {
    if (frame.kind != kind_of<Message>) {
      refuse(kind_name(kind_of<Message>), frame);
    }
    if (!parse(frame, message)) {
      refuse_damaged(frame);
    }
  }

  /// As above, and the message must be of this window: "expected Kinematics of window 17, got Kinematics of window 18".
  template <Body Message>
  void take(const Frame& frame, Message& message, std::uint64_t window) const {
    if (frame.kind != kind_of<Message> || window_of(frame) != window) {
      refuse(kind_name(kind_of<Message>) + " of window " + std::to_string(window), frame);
    }
    take(frame, message);
    // A field that comes twice counts as what it is last; window_of() read it where it is first.
    if constexpr (requires { message.window(); }) {
      if (message.window() != window) refuse_damaged(frame);
    }
  }

  /// Throws the PeerError for a message that does not belong here.
  [[noreturn]] void refuse(const std::string& expected, const Frame& frame) const;

  [[nodiscard]] const std::string& peer() const noexcept { return peer_; }
  [[nodiscard]] transport::Channel& channel() noexcept { return channel_; }

 private:
  [[noreturn]] void refuse_damaged(const Frame& frame) const;

  transport::Channel& channel_;
  std::string peer_;
  Encoder encoder_;
  Decoder decoder_;
  transport::Bytes received_;
  Frame frame_;
  bool put_back_ = false;
};

}  // namespace grainstep::wire
