#include "wire/message_channel.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "patience.hpp"
#include "transport/faulty_channel.hpp"
#include "transport/in_process_channel.hpp"

namespace grainstep::wire {
namespace {

struct TwoEnds {
  std::pair<std::unique_ptr<transport::Channel>, std::unique_ptr<transport::Channel>> channels =
      transport::make_in_process_pair();
  MessageChannel left{*channels.first, "right"};
  MessageChannel right{*channels.second, "left"};
};

template <class Call>
std::string peer_error(Call&& call) {
  try {
    call();
  } catch (const PeerError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MessageChannel, carries_messages) {
  TwoEnds ends;
  Forces forces;
  forces.set_window(4);
  forces.add_impulse(2.5);
  ends.left.send(forces);
  const Frame* frame = ends.right.receive(grainstep::testing::soon());
  ASSERT_NE(frame, nullptr);
  Forces received;
  ends.right.take(*frame, received, 4);
  EXPECT_EQ(received.impulse(0), 2.5);
  EXPECT_EQ(ends.right.receive(transport::Clock::now()), nullptr);
}

TEST(MessageChannel, an_order_that_is_broken_is_told_in_full) {
  TwoEnds ends;
  Kinematics kinematics;
  kinematics.set_window(18);
  ends.left.send(kinematics);
  Error error;
  error.set_text("element 7 inverted");
  ends.left.send(error);
  const auto soon = grainstep::testing::soon();
  Kinematics into;
  Ready ready;
  const Frame* frame = ends.right.receive(soon);
  EXPECT_EQ(peer_error([&] { ends.right.take(*frame, into, 17); }),
            "left: message 1: expected Kinematics of window 17, got Kinematics of window 18");
  EXPECT_EQ(peer_error([&] { ends.right.take(*frame, ready); }),
            "left: message 1: expected Ready, got Kinematics of window 18");
  frame = ends.right.receive(soon);
  EXPECT_EQ(peer_error([&] { ends.right.take(*frame, into, 17); }),
            "left: message 2: expected Kinematics of window 17, got Error: element 7 inverted");
}

/// What the receiver says when the second of three messages is mistreated on its way.
std::string noticed(transport::Fault fault) {
  auto [left, right] = transport::make_in_process_pair();
  transport::FaultyChannel faulty(*left, fault);
  MessageChannel sender(faulty, "right");
  MessageChannel receiver(*right, "left");
  for (std::uint64_t window = 1; window <= 3; ++window) {
    Forces forces;
    forces.set_window(window);
    forces.add_impulse(1.0);
    sender.send(forces);
  }
  return peer_error([&] {
    while (receiver.receive(transport::Clock::now()) != nullptr) {
    }
  });
}

TEST(MessageChannel, notices_every_fault_of_the_way) {
  using Kind = transport::Fault::Kind;
  const std::string lost = "left: message 2: found sequence number 3, expected 2: messages were lost or repeated";
  EXPECT_EQ(noticed({Kind::drop, 2, 0}), lost);
  EXPECT_EQ(noticed({Kind::delay, 2, 0}), lost);
  EXPECT_EQ(noticed({Kind::duplicate, 2, 0}),
            "left: message 3: found sequence number 2, expected 3: messages were lost or repeated");
  EXPECT_EQ(noticed({Kind::truncate, 2, 10}), "left: message 2: found a frame of 10 bytes, expected at least 24");
  EXPECT_NE(noticed({Kind::flip_bit, 2, std::size_t{8} * 30}).find("left: message 2: checksum"), std::string::npos);
}

// Protobuf takes the last of a field's values, a look at the first bytes the first: they must not be used as two
// windows.
TEST(MessageChannel, a_window_that_is_named_twice_is_refused) {
  TwoEnds ends;
  Forces first;
  first.set_window(5);
  Forces second;
  second.set_window(1000000);
  const std::string body = first.SerializeAsString() + second.SerializeAsString();
  const std::string payload = std::string("\x2a") + static_cast<char>(body.size()) + body;  // field 5, a length
  Encoder encoder;
  ends.channels.first->send(encoder.forward(std::as_bytes(std::span(payload))));
  const Frame* frame = ends.right.receive(grainstep::testing::soon());
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(window_of(*frame), 5U);
  Forces into;
  EXPECT_EQ(peer_error([&] { ends.right.take(*frame, into, 5); }),
            "left: message 1: the bytes of this Forces are not a valid message of its kind");
}

}  // namespace
}  // namespace grainstep::wire
