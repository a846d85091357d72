/// @file Messages one way through shared memory: one writer, its peer that waits for them, and one who listens.
///
/// A ring of slots of one size. The writer counts what it has written, each reader what it has read; a slot is written
/// again when both have read it. Nobody trusts what others may have written here: sizes and counts are checked, and a
/// message is copied before anybody looks at it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "transport/channel.hpp"

namespace grainstep::transport {

struct RingShape {
  std::uint64_t slot_bytes = 0;  ///< the longest message
  std::uint64_t slots = 0;
};

class SharedRing {
 public:
  enum Reader : unsigned { peer = 0, listener = 1 };

  [[nodiscard]] static std::size_t bytes_for(const RingShape& shape);

  /// Over `memory` of bytes_for(shape), all zero when the first of its users comes.
  SharedRing(std::span<std::byte> memory, const RingShape& shape);

  /// False: full, a reader is behind. std::length_error for what is longer than a slot.
  [[nodiscard]] bool write(std::span<const std::byte> message);

  /// False: nothing is there. std::range_error where counts or sizes are none that the writer can have written.
  [[nodiscard]] bool read(Reader reader, Bytes& message);

  /// Whether there is something to read.
  [[nodiscard]] bool pending() const;

  /// For the writer: a message comes within microseconds. A peer that sleeps is woken for it.
  void knock();

  /// For the peer: true when there is something to read or soon will be; false at the deadline, or woken for nothing.
  [[nodiscard]] bool sleep(Deadline deadline);

 private:
  struct Counts;
  void ring_bell();
  [[nodiscard]] std::byte* slot(std::uint64_t number) const;

  Counts& counts_;
  std::byte* slots_;
  RingShape shape_;
  std::uint64_t done_ = 0;  ///< by this end: what it has written, or read
};

}  // namespace grainstep::transport
