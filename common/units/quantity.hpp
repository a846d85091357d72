/// @file Numbers with units, as people write them, to SI. Used at the edge only: everything inside is SI.
///
/// Threads: safe to call from any thread (UDUNITS-2 itself is not; calls are serialised).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace grainstep::units {

/// "200 um" as it stands: value 200, digits "200", unit "um". A bare number has an empty unit.
struct WrittenNumber {
  double value = 0;
  std::string digits;
  std::string unit;
};

/// Splits the number from its unit. nullopt: `text` does not begin with a number.
/// @throws InputError if the number is not finite (nan, inf, 1e999), or goes on in a way that other programs know
/// (1d-3, 1,5, 1 e-3).
[[nodiscard]] std::optional<WrittenNumber> split_number(std::string_view text);

/// `text` in `unit` (UDUNITS spelling; empty: a pure number). A bare number is taken to be in `unit` already.
/// An angle is no pure number, and a pure number no angle. Decimal prefixes are exact: "200 um", "0.2 mm" and "0.0002"
/// give the same bits, hence the same scene.
/// @throws InputError naming the text, what it is, and the unit that was expected.
[[nodiscard]] double parse_quantity(std::string_view text, std::string_view unit);

/// Whether UDUNITS-2 knows `unit`.
[[nodiscard]] bool is_unit(std::string_view unit);

}  // namespace grainstep::units
