/// @file Numbers as text.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace grainstep::scene {

/// The shortest that reads back as the same number.
[[nodiscard]] inline std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general);
  return {buffer.data(), result.ptr};
}

/// Six digits, for messages to people.
[[nodiscard]] inline std::string rounded_text(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6);
  return {buffer.data(), result.ptr};
}

/// A length, for messages to people.
[[nodiscard]] inline std::string metres(double value) { return rounded_text(value) + " m"; }

}  // namespace grainstep::scene
