/// The decorators that other tests rely on.
#include <gtest/gtest.h>

#include "transport/faulty_channel.hpp"
#include "transport/in_process_channel.hpp"
#include "transport/recording_channel.hpp"

namespace grainstep::transport {
namespace {

std::vector<Bytes> arriving(Fault fault) {
  auto [left, right] = make_in_process_pair();
  FaultyChannel faulty(*left, fault);
  RecordingChannel recorder(*right);
  for (int i = 1; i <= 3; ++i) {
    faulty.send(Bytes(2, static_cast<std::byte>(i)));
  }
  Bytes message;
  while (recorder.receive(message, Clock::now())) {
  }
  return recorder.received();
}

Bytes two(int value) { return Bytes(2, static_cast<std::byte>(value)); }

TEST(FaultyChannel, does_what_it_says) {
  using Kind = Fault::Kind;
  using Messages = std::vector<Bytes>;
  EXPECT_EQ(arriving({Kind::drop, 2, 0}), (Messages{two(1), two(3)}));
  EXPECT_EQ(arriving({Kind::duplicate, 2, 0}), (Messages{two(1), two(2), two(2), two(3)}));
  EXPECT_EQ(arriving({Kind::delay, 2, 0}), (Messages{two(1), two(3), two(2)}));
  EXPECT_EQ(arriving({Kind::truncate, 2, 1}), (Messages{two(1), Bytes(1, std::byte{2}), two(3)}));
  EXPECT_EQ(arriving({Kind::flip_bit, 2, 8}), (Messages{two(1), {std::byte{2}, std::byte{3}}, two(3)}));
}

TEST(RecordingChannel, keeps_what_was_sent) {
  auto [left, right] = make_in_process_pair();
  RecordingChannel recorder(*left);
  recorder.send(two(5));
  Bytes message;
  ASSERT_TRUE(right->receive(message, Clock::now()));
  EXPECT_EQ(message, two(5));
  EXPECT_EQ(recorder.sent(), std::vector<Bytes>{two(5)});
}

}  // namespace
}  // namespace grainstep::transport
