/// @file A participant's state on its way: in State messages of a bounded size, each with a checksum.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "wire/message_channel.hpp"

namespace grainstep::wire {

inline constexpr std::size_t largest_state_part = std::size_t{16} << 20U;  // bytes

/// How many messages a state of that size takes; none takes one.
[[nodiscard]] std::uint32_t state_parts(std::size_t bytes);

/// Sends all parts of the state of window n.
void send_state(MessageChannel& messages, std::uint64_t window, std::string_view state);

/// Puts together what send_state() took apart.
class StateParts {
 public:
  /// Of window n. PeerError in the name of `peer` for parts that do not belong together, are damaged, or are more than
  /// `most` bytes.
  StateParts(std::string peer, std::uint64_t window, std::size_t most)
      : peer_(std::move(peer)), window_(window), most_(most) {}

  void add(const State& part);

  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  [[noreturn]] void refuse(const std::string& text) const;

  std::string peer_;
  std::uint64_t window_;
  std::size_t most_;
  std::uint32_t count_ = 0;
  std::string bytes_;
};

}  // namespace grainstep::wire
