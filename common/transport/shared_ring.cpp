#include "transport/shared_ring.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <new>
#include <stdexcept>
#include <string>

namespace grainstep::transport {
namespace {

constexpr std::size_t line = 64;  // of a cache: what one side writes does not share it with what the other writes

constexpr std::size_t rounded_up(std::size_t bytes) { return (bytes + line - 1) / line * line; }

constexpr std::size_t stride_of(const RingShape& shape) {
  return rounded_up(sizeof(std::uint64_t) + static_cast<std::size_t>(shape.slot_bytes));
}

// Between processes: std::atomic::wait is for the threads of one.
void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t while_it_is, std::chrono::nanoseconds most) {
  const timespec time{.tv_sec = static_cast<std::time_t>(most.count() / 1'000'000'000),
                      .tv_nsec = static_cast<long>(most.count() % 1'000'000'000)};
  ::syscall(SYS_futex, &word, FUTEX_WAIT, while_it_is, &time, nullptr, 0);
}

void futex_wake(std::atomic<std::uint32_t>& word) { ::syscall(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0); }

}  // namespace

/// Lock-free, so that they are the same in every process, and zero where nobody has written yet.
struct SharedRing::Counts {
  alignas(line) std::atomic<std::uint64_t> written;
  std::atomic<std::uint32_t> bell;  ///< rings with every message and every knock: what a sleeper sleeps on
  alignas(line) std::atomic<std::uint64_t> read[2];
  alignas(line) std::atomic<std::uint32_t> asleep;  ///< the peer sleeps, or is about to
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<std::uint32_t>::is_always_lock_free);

std::size_t SharedRing::bytes_for(const RingShape& shape) {
  return sizeof(Counts) + static_cast<std::size_t>(shape.slots) * stride_of(shape);
}

SharedRing::SharedRing(std::span<std::byte> memory, const RingShape& shape)
    : counts_(*std::launder(reinterpret_cast<Counts*>(memory.data()))),
      slots_(memory.data() + sizeof(Counts)),
      shape_(shape) {
  if (shape.slots == 0 || memory.size() < bytes_for(shape)) {
    throw std::length_error("a ring of " + std::to_string(shape.slots) + " slots does not fit its memory");
  }
}

std::byte* SharedRing::slot(std::uint64_t number) const {
  return slots_ + static_cast<std::size_t>(number % shape_.slots) * stride_of(shape_);
}

bool SharedRing::write(std::span<const std::byte> message) {
  if (message.size() > shape_.slot_bytes) {
    throw std::length_error("a message of " + std::to_string(message.size()) + " bytes, but its slot has " +
                            std::to_string(shape_.slot_bytes));
  }
  for (const auto& read : counts_.read) {
    if (done_ - read.load(std::memory_order_acquire) >= shape_.slots) return false;
  }
  std::byte* const to = slot(done_);
  const std::uint64_t size = message.size();
  std::memcpy(to, &size, sizeof size);
  std::memcpy(to + sizeof size, message.data(), message.size());
  counts_.written.store(++done_, std::memory_order_release);
  ring_bell();
  return true;
}

void SharedRing::ring_bell() {
  // In one order with the sleeper's "asleep": it sees the bell, or we see it asleep.
  counts_.bell.fetch_add(1, std::memory_order_seq_cst);
  if (counts_.asleep.load(std::memory_order_seq_cst) != 0) futex_wake(counts_.bell);
}

void SharedRing::knock() {
  if (counts_.asleep.load(std::memory_order_relaxed) != 0) ring_bell();
}

bool SharedRing::read(Reader reader, Bytes& message) {
  const std::uint64_t written = counts_.written.load(std::memory_order_acquire);
  if (written == done_) return false;
  if (written - done_ > shape_.slots) {
    throw std::range_error(std::to_string(written) + " messages cannot have been written, " + std::to_string(done_) +
                           " were read of " + std::to_string(shape_.slots) + " slots");
  }
  const std::byte* const from = slot(done_);
  std::uint64_t size = 0;
  std::memcpy(&size, from, sizeof size);
  if (size > shape_.slot_bytes) {
    throw std::range_error("message " + std::to_string(done_ + 1) + " has " + std::to_string(size) +
                           " bytes, but its slot has " + std::to_string(shape_.slot_bytes));
  }
  message.assign(from + sizeof size, from + sizeof size + size);
  counts_.read[reader].store(++done_, std::memory_order_release);
  return true;
}

bool SharedRing::pending() const { return counts_.written.load(std::memory_order_acquire) != done_; }

bool SharedRing::sleep(Deadline deadline) {
  const std::uint32_t bell = counts_.bell.load(std::memory_order_seq_cst);
  if (pending()) return true;
  counts_.asleep.store(1, std::memory_order_seq_cst);
  const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(deadline - Clock::now());
  if (counts_.bell.load(std::memory_order_seq_cst) == bell && left.count() > 0) {
    futex_wait(counts_.bell, bell, left);
  }
  counts_.asleep.store(0, std::memory_order_relaxed);
  return counts_.bell.load(std::memory_order_seq_cst) != bell;
}

}  // namespace grainstep::transport
