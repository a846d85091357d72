#include "transport/in_process_channel.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"

namespace grainstep::transport {
namespace {

TEST(InProcessChannel, a_steady_exchange_uses_the_same_few_buffers) {
  auto [left, right] = make_in_process_pair();
  Bytes message;
  std::set<const std::byte*> buffers;
  for (int i = 0; i < 1000; ++i) {
    left->send(Bytes(500));
    ASSERT_TRUE(right->receive(message, Clock::now()));
    buffers.insert(message.data());
  }
  EXPECT_LE(buffers.size(), 5U);  // a ring of four, and the receiver's own
}

TEST(InProcessChannel, the_queue_grows_with_what_is_in_flight) {
  auto [left, right] = make_in_process_pair();
  for (int i = 0; i < 100; ++i) {
    left->send(Bytes(static_cast<std::size_t>(i)));
  }
  Bytes message;
  for (std::size_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(right->receive(message, Clock::now()));
    EXPECT_EQ(message.size(), i);
  }
}

TEST(InProcessChannel, errors_name_the_other_end) {
  auto [left, right] = make_in_process_pair({.first = "orchestrator", .second = "impactor"});
  right.reset();
  try {
    left->send({});
    FAIL() << "sent";
  } catch (const PeerError& error) {
    EXPECT_EQ(error.peer(), "impactor");
  }
}

}  // namespace
}  // namespace grainstep::transport
