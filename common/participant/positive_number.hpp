/// @file A check for options of all programs: CLI11's own names the largest double, digit by digit.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace grainstep::participant {

[[nodiscard]] inline CLI::Validator positive_number() {
  return {[](std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            return number && value > 0.0 ? std::string() : "'" + text + "' is no number above 0";
          },
          "NUMBER > 0"};
}

}  // namespace grainstep::participant
