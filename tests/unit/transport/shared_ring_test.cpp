/// @file The rings of the short path of data: what is written is read by both readers, once, in order; what others may
/// have written there is checked.
#include "transport/shared_ring.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "patience.hpp"

namespace grainstep::transport {
namespace {

constexpr RingShape shape{.slot_bytes = 40, .slots = 4};

Bytes bytes_of(const std::string& text) {
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

std::string text_of(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

struct alignas(64) Line {
  std::byte bytes[64] = {};
};

class Ring : public ::testing::Test {
 protected:
  [[nodiscard]] std::span<std::byte> memory() { return std::as_writable_bytes(std::span(lines_)); }
  [[nodiscard]] SharedRing end() { return {memory(), shape}; }
  /// What the next message says; "" where there is none.
  static std::string next(SharedRing& ring, SharedRing::Reader reader) {
    Bytes message;
    return ring.read(reader, message) ? text_of(message) : "";
  }

  std::vector<Line> lines_ = std::vector<Line>(SharedRing::bytes_for(shape) / sizeof(Line) + 1);
};

TEST_F(Ring, BothReadersReadEveryMessageOnceInOrder) {
  SharedRing writer = end();
  SharedRing peer = end();
  SharedRing listener = end();
  for (int i = 0; i < 25; ++i) {  // the slots are used again and again
    const std::string text(static_cast<std::size_t>(i + 1), static_cast<char>('a' + i));
    ASSERT_TRUE(writer.write(bytes_of(text)));
    EXPECT_EQ(next(peer, SharedRing::peer), text);
    EXPECT_EQ(next(listener, SharedRing::listener), text);
    EXPECT_EQ(next(peer, SharedRing::peer), "");
    EXPECT_EQ(next(listener, SharedRing::listener), "");
  }
}

TEST_F(Ring, ASlotIsWrittenAgainOnlyWhenBothHaveReadIt) {
  SharedRing writer = end();
  SharedRing peer = end();
  SharedRing listener = end();
  for (const char* text : {"1", "2", "3", "4"}) ASSERT_TRUE(writer.write(bytes_of(text)));
  EXPECT_FALSE(writer.write(bytes_of("5")));
  EXPECT_EQ(next(peer, SharedRing::peer), "1");
  EXPECT_FALSE(writer.write(bytes_of("5"))) << "the listener has not read it";
  EXPECT_EQ(next(listener, SharedRing::listener), "1");
  EXPECT_TRUE(writer.write(bytes_of("5")));
  EXPECT_EQ(next(listener, SharedRing::listener), "2");
}

TEST_F(Ring, TakesNoMessageLongerThanASlot) {
  SharedRing writer = end();
  EXPECT_TRUE(writer.write(Bytes(shape.slot_bytes)));
  EXPECT_THROW(static_cast<void>(writer.write(Bytes(shape.slot_bytes + 1))), std::length_error);
}

TEST_F(Ring, DoesNotFitLessMemory) {
  EXPECT_THROW(SharedRing(memory().first(SharedRing::bytes_for(shape) - 1), shape), std::length_error);
  EXPECT_THROW(SharedRing(memory(), RingShape{.slot_bytes = 40, .slots = 0}), std::length_error);
}

// A count that no writer of these slots can have reached, and a length that no slot has: neither becomes an address.
TEST_F(Ring, RefusesCountsAndLengthsThatNobodyCanHaveWritten) {
  for (const std::uint64_t written : {std::uint64_t{5}, ~std::uint64_t{0}}) {
    std::memcpy(memory().data(), &written, sizeof written);
    SharedRing peer = end();
    Bytes message;
    EXPECT_THROW(static_cast<void>(peer.read(SharedRing::peer, message)), std::range_error);
  }
  const std::uint64_t one = 1;
  std::memcpy(memory().data(), &one, sizeof one);
  const std::size_t first_slot = SharedRing::bytes_for(shape) - shape.slots * 64;
  for (const std::uint64_t length : {std::uint64_t{41}, ~std::uint64_t{0}}) {
    std::memcpy(memory().data() + first_slot, &length, sizeof length);
    SharedRing peer = end();
    Bytes message;
    EXPECT_THROW(static_cast<void>(peer.read(SharedRing::peer, message)), std::range_error);
  }
}

TEST_F(Ring, ASleeperReturnsAtItsDeadline) {
  SharedRing peer = end();
  const Deadline deadline = in(std::chrono::milliseconds(20));
  while (Clock::now() < deadline) EXPECT_FALSE(peer.sleep(deadline));
  EXPECT_EQ(next(peer, SharedRing::peer), "");
}

TEST_F(Ring, AKnockWakesASleeperWithoutAMessage) {
  SharedRing peer = end();
  std::atomic<bool> woken = false;
  std::thread knocking([&] {
    SharedRing writer = end();
    while (!woken) writer.knock();
  });
  while (!peer.sleep(grainstep::testing::soon())) {
  }
  woken = true;
  knocking.join();
  EXPECT_FALSE(peer.pending());
}

// Without a bell that rings a sleep lasts until its deadline, whatever is written.
TEST_F(Ring, ASleeperIsWokenByEveryMessage) {
  constexpr int messages = 20000;
  std::atomic<bool> over = false;
  std::thread writing([&] {
    SharedRing writer = end();
    for (int i = 0; i < messages && !over;) {
      writer.write(bytes_of(std::to_string(i))) ? static_cast<void>(++i) : std::this_thread::yield();
    }
  });
  std::thread listening([&] {
    SharedRing listener = end();
    for (int i = 0; i < messages && !over;) {
      const std::string text = next(listener, SharedRing::listener);
      if (text.empty()) {
        std::this_thread::yield();
        continue;
      }
      EXPECT_EQ(text, std::to_string(i++));
    }
  });
  SharedRing peer = end();
  for (int i = 0; i < messages && !over; ++i) {
    const Deadline deadline = grainstep::testing::soon();
    std::string text;
    while ((text = next(peer, SharedRing::peer)).empty() && !over) {
      static_cast<void>(peer.sleep(deadline));
      over = Clock::now() >= deadline;
    }
    EXPECT_EQ(text, std::to_string(i));
  }
  EXPECT_FALSE(over) << "slept until its deadline";
  over = true;
  writing.join();
  listening.join();
}

}  // namespace
}  // namespace grainstep::transport
