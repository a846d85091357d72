#include "base/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace grainstep {
namespace {

using Buffer = std::array<char, 64>;
constexpr int most_digits = 17;

/// Units that begin with one of these take a prefix: m, m/s, s, N/m, Pa. Not kg/m^3, 1/s, rad.
constexpr std::string_view prefixed_units = "msNP";

/// From 1e-12 to 1e12, in steps of a thousand.
constexpr std::array<std::string_view, 9> prefixes{"p", "n", "u", "m", "", "k", "M", "G", "T"};
constexpr int prefix_of_one = 4;

}  // namespace

std::string number_text(double value) {
  Buffer buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general);
  return {buffer.data(), result.ptr};
}

std::string rounded_text(double value, int digits) {
  Buffer buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general,
                                    std::min(digits, most_digits));
  return {buffer.data(), result.ptr};
}

std::string figure(double value, int digits) { return std::isfinite(value) ? rounded_text(value, digits) : "-"; }

std::string metres(double value) { return rounded_text(value) + " m"; }

std::string prefixed_text(double value, std::string_view unit) {
  if (unit.empty()) return rounded_text(value);
  int step = 0;
  if (value != 0.0 && std::isfinite(value) && prefixed_units.find(unit.front()) != std::string_view::npos) {
    constexpr double round_off = 1e-9;  // of the logarithm of a power of ten
    step = static_cast<int>(std::floor(std::log10(std::abs(value)) / 3.0 + round_off));
    step = std::clamp(step, -prefix_of_one, prefix_of_one);
  }
  const auto prefix = prefixes[static_cast<std::size_t>(step + prefix_of_one)];
  return rounded_text(value * std::pow(10.0, -3 * step)) + " " + std::string(prefix) + std::string(unit);
}

}  // namespace grainstep
