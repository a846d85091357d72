/// @file A check for options of all programs that are times to wait for: CLI11's own names the largest double, digit by
/// digit.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace grainstep::participant {

/// s, eleven days: libraries count milliseconds in 31 bits.
inline constexpr double longest_wait = 1e6;

[[nodiscard]] inline CLI::Validator seconds_to_wait() {
  return {[](std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            return number && value > 0.0 && value <= longest_wait
                       ? std::string()
                       : "'" + text + "' is no number of seconds above 0 and up to 1000000";
          },
          "SECONDS"};
}

}  // namespace grainstep::participant
