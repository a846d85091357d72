#include "channel_contract.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <cstring>
#include <thread>

#include "base/error.hpp"
#include "patience.hpp"

namespace grainstep::transport::testing {
namespace {

using grainstep::testing::soon;

class ChannelContract : public ::testing::TestWithParam<Implementation> {
 protected:
  static Bytes bytes(std::uint64_t value, std::size_t size = sizeof(std::uint64_t)) {
    Bytes result(size);
    for (std::size_t i = 0; i < size; ++i) {
      result[i] = static_cast<std::byte>(value >> (8 * (i % 8)));
    }
    return result;
  }

  ConnectedPair pair_ = GetParam().connect();
  Channel& left_ = *pair_.left;
  Channel& right_ = *pair_.right;
  Bytes received_;
};

TEST_P(ChannelContract, keeps_order_and_loses_nothing) {
  constexpr std::uint64_t count = 5000;
  std::thread sender([&] {
    for (std::uint64_t i = 0; i < count; ++i) {
      left_.send(bytes(i, 8 + i % 300));
    }
  });
  for (std::uint64_t i = 0; i < count; ++i) {
    ASSERT_TRUE(right_.receive(received_, soon()));
    ASSERT_EQ(received_, bytes(i, 8 + i % 300)) << "message " << i;
  }
  sender.join();
  EXPECT_FALSE(right_.receive(received_, Clock::now()));
}

TEST_P(ChannelContract, both_ways_at_once) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    left_.send(bytes(2 * i));
    right_.send(bytes(2 * i + 1));
  }
  for (std::uint64_t i = 0; i < 200; ++i) {
    ASSERT_TRUE(right_.receive(received_, soon()));
    EXPECT_EQ(received_, bytes(2 * i));
    ASSERT_TRUE(left_.receive(received_, soon()));
    EXPECT_EQ(received_, bytes(2 * i + 1));
  }
}

TEST_P(ChannelContract, carries_empty_and_big_messages) {
  const auto big = bytes(0x0123456789abcdef, std::size_t{64} << 20);
  left_.send({});
  left_.send(big);
  left_.send({});
  ASSERT_TRUE(right_.receive(received_, soon()));
  EXPECT_TRUE(received_.empty());
  ASSERT_TRUE(right_.receive(received_, soon()));
  EXPECT_TRUE(received_ == big);
  ASSERT_TRUE(right_.receive(received_, soon()));
  EXPECT_TRUE(received_.empty());
}

TEST_P(ChannelContract, returns_at_the_deadline_and_not_before) {
  const auto deadline = in(std::chrono::milliseconds(20));
  EXPECT_FALSE(right_.receive(received_, deadline));
  EXPECT_GE(Clock::now(), deadline);
}

TEST_P(ChannelContract, a_waiting_receiver_is_woken) {
  std::thread echo([&] {
    Bytes message;
    EXPECT_TRUE(right_.receive(message, soon()));
    right_.send(message);
  });
  left_.send(bytes(7));
  EXPECT_TRUE(left_.receive(received_, soon()));
  EXPECT_EQ(received_, bytes(7));
  echo.join();
}

TEST_P(ChannelContract, poll_on_the_wakeup_descriptor_sees_every_message) {
  ASSERT_GE(right_.wakeup(), 0);
  std::thread sender([&] {
    for (std::uint64_t i = 0; i < 100; ++i) {
      left_.send(bytes(i));
    }
  });
  std::uint64_t taken = 0;
  while (taken < 100) {
    while (right_.receive(received_, Clock::now())) {
      ASSERT_EQ(received_, bytes(taken++));
    }
    pollfd item{right_.wakeup(), POLLIN, 0};
    ASSERT_TRUE(taken == 100 || ::poll(&item, 1, grainstep::testing::patience_ms) == 1) << "after message " << taken;
  }
  sender.join();
}

TEST_P(ChannelContract, the_receivers_buffer_is_reused) {
  received_.reserve(1000);
  const auto big_enough = received_.capacity();
  for (std::uint64_t i = 0; i < 50; ++i) {
    left_.send(bytes(i, 900));
    ASSERT_TRUE(right_.receive(received_, soon()));
  }
  EXPECT_GE(received_.capacity(), 900U);
  EXPECT_LE(received_.capacity(), 2 * big_enough);
}

TEST_P(ChannelContract, a_lost_peer_is_an_error_after_its_last_message) {
  left_.send(bytes(1));
  left_.send(bytes(2));
  pair_.left.reset();
  ASSERT_TRUE(right_.receive(received_, soon()));
  EXPECT_EQ(received_, bytes(1));
  ASSERT_TRUE(right_.receive(received_, soon()));
  EXPECT_EQ(received_, bytes(2));
  EXPECT_THROW((void)right_.receive(received_, soon()), PeerError);
  EXPECT_THROW((void)right_.receive(received_, soon()), PeerError);
  EXPECT_THROW(right_.send(bytes(3)), PeerError);
}

TEST_P(ChannelContract, the_loss_is_seen_from_either_end) {
  right_.send(bytes(9));
  pair_.right.reset();
  ASSERT_TRUE(left_.receive(received_, soon()));
  EXPECT_EQ(received_, bytes(9));
  EXPECT_THROW((void)left_.receive(received_, soon()), PeerError);
  EXPECT_THROW(left_.send(bytes(3)), PeerError);
}

TEST_P(ChannelContract, a_loss_wakes_poll) {
  while (right_.receive(received_, Clock::now())) {
  }
  std::thread closer([&] { pair_.left.reset(); });
  bool lost = false;
  while (!lost) {
    try {
      ASSERT_FALSE(right_.receive(received_, Clock::now()));
      pollfd item{right_.wakeup(), POLLIN, 0};
      ASSERT_EQ(::poll(&item, 1, grainstep::testing::patience_ms), 1);
    } catch (const PeerError&) {
      lost = true;
    }
  }
  closer.join();
}

INSTANTIATE_TEST_SUITE_P(Channels, ChannelContract, ::testing::ValuesIn(implementations()),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace grainstep::transport::testing
