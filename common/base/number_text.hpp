/// @file Numbers as text: for files, for messages, for tables.
#pragma once

#include <string>
#include <string_view>

namespace grainstep {

/// The shortest that reads back as the same number.
[[nodiscard]] std::string number_text(double value);

/// Significant digits, for messages to people.
[[nodiscard]] std::string rounded_text(double value, int digits = 6);

/// The same for tables: "-" for what is not a number, or not finite.
[[nodiscard]] std::string figure(double value, int digits);

/// A length, for messages to people.
[[nodiscard]] std::string metres(double value);

/// As people write it, with a decimal prefix where the unit takes one: 0.47 Pa is "470 mPa", 2700 kg/m^3 is
/// "2700 kg/m^3". `unit` may be empty.
[[nodiscard]] std::string prefixed_text(double value, std::string_view unit);

}  // namespace grainstep
