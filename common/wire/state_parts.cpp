#include "wire/state_parts.hpp"

#include <xxhash.h>

#include <algorithm>

#include "base/error.hpp"

namespace grainstep::wire {

std::uint32_t state_parts(std::size_t bytes) {
  return static_cast<std::uint32_t>(std::max<std::size_t>(1, (bytes + largest_state_part - 1) / largest_state_part));
}

void send_state(MessageChannel& messages, std::uint64_t window, std::string_view state) {
  State message;
  message.set_window(window);
  for (std::uint32_t part = 0; part < state_parts(state.size()); ++part) {
    const std::string_view bytes = state.substr(part * largest_state_part, largest_state_part);
    message.set_chunk(part);
    message.set_data(bytes.data(), bytes.size());
    message.set_checksum(XXH3_64bits(bytes.data(), bytes.size()));
    messages.send(message);
  }
}

void StateParts::refuse(const std::string& text) const {
  throw PeerError(peer_, "State of window " + std::to_string(window_) + ": " + text);
}

void StateParts::add(const State& part) {
  if (part.window() != window_) refuse("a part is of window " + std::to_string(part.window()));
  if (part.chunk() != count_) {
    refuse("expected part " + std::to_string(count_) + ", got part " + std::to_string(part.chunk()));
  }
  const std::string& bytes = part.data();
  if (bytes.size() > largest_state_part) refuse("a part of " + std::to_string(bytes.size()) + " bytes is too large");
  if (bytes_.size() + bytes.size() > most_) refuse("more than " + std::to_string(most_) + " bytes");
  if (XXH3_64bits(bytes.data(), bytes.size()) != part.checksum()) {
    refuse("part " + std::to_string(count_) + " is damaged");
  }
  bytes_ += bytes;
  ++count_;
}

}  // namespace grainstep::wire
