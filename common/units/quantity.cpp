#include "units/quantity.hpp"

#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <mutex>

#include "base/error.hpp"

namespace grainstep::units {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

/// Longer texts are not units that a person would write, and the parser need not see them.
constexpr std::size_t longest_unit = 64;

std::mutex& udunits_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// The unit database, read once; the caller holds the mutex.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* const read = ut_read_xml(nullptr);
    // Everybody writes deg; the database only knows degree and arc_degree.
    if (read != nullptr) ut_map_name_to_unit("deg", UT_ASCII, Unit(ut_parse(read, "arc_degree", UT_ASCII)).get());
    return read;
  }();
  if (system == nullptr) {
    throw InputError(
        "the unit database of UDUNITS-2 cannot be read: install libudunits2-data, or let UDUNITS2_XML_PATH name its "
        "udunits2.xml");
  }
  return system;
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// nullptr: not a unit. A unit here is a name: a second number ("100 200 um") or an origin ("s since 1970", "K @ 273")
/// would scale or shift the value unseen.
Unit parse_unit(std::string_view text) {
  if (text.empty()) text = "1";
  if (text.size() > longest_unit || text.find('@') != std::string_view::npos) return nullptr;
  const bool pure_number_start =
      (text[0] >= '0' && text[0] <= '9') || text[0] == '+' || text[0] == '-' || text[0] == '.';
  if (pure_number_start && text != "1" && !text.starts_with("1/")) return nullptr;
  for (const auto* const word : {"since", "after", "from", "ref"}) {
    if (text.find(word) != std::string_view::npos) return nullptr;
  }
  return Unit(ut_parse(unit_system(), std::string(text).c_str(), UT_UTF8));
}

std::string base_units(const ut_unit* unit) {
  std::array<char, 128> buffer{};
  const int length = ut_format(unit, buffer.data(), buffer.size() - 1, UT_ASCII | UT_DEFINITION);
  return length > 0 ? std::string(buffer.data()) : std::string("?");
}

/// Of the same powers of the base units. Two doors of UDUNITS are closed: it would turn a period into a rate by its
/// reciprocal, and it takes radians for pure numbers, but 35 deg is no coefficient of friction.
bool same_dimension(const ut_unit* one, const ut_unit* other) {
  const Unit quotient(ut_divide(one, other));
  return quotient && ut_is_dimensionless(quotient.get()) != 0 &&
         base_units(quotient.get()).find("rad") == std::string::npos;
}

/// What a quantity of this dimension is called, for messages.
std::string dimension_name(const ut_unit* unit) {
  struct Named {
    const char* unit;
    const char* name;
  };
  static constexpr std::array names{
      Named{"m", "a length"},
      Named{"s", "a time"},
      Named{"kg", "a mass"},
      Named{"m/s", "a speed"},
      Named{"m/s2", "an acceleration"},
      Named{"m2", "an area"},
      Named{"m3", "a volume"},
      Named{"kg/m3", "a density"},
      Named{"kg/m2", "an areal mass"},
      Named{"N", "a force"},
      Named{"N/m", "a stiffness"},
      Named{"Pa", "a pressure or stress"},
      Named{"J", "an energy"},
      Named{"N s", "an impulse"},
      Named{"s-1", "a rate"},
      Named{"Pa s", "a viscosity"},
      Named{"K", "a temperature"},
      Named{"rad", "an angle"},
      Named{"rad/s", "an angular speed"},
      Named{"1", "a pure number"},
  };
  for (const auto& [text, name] : names) {
    const Unit candidate = parse_unit(text);
    if (candidate && same_dimension(unit, candidate.get())) return name;
  }
  return "a quantity in " + base_units(unit);
}

std::string expectation(std::string_view unit) {
  return unit.empty() ? std::string("a pure number") : "a number with a unit of " + std::string(unit);
}

/// `digits` times 10^power, rounded once: the decimal point is moved in the text. nullopt: the exponent is beyond an
/// int.
std::optional<double> move_decimal_point(const std::string& digits, int power) {
  const auto at = digits.find_first_of("eE");
  int exponent = 0;
  if (at != std::string::npos) {
    const char* first = digits.data() + at + 1;
    if (*first == '+') ++first;
    const auto [end, error] = std::from_chars(first, digits.data() + digits.size(), exponent);
    if (error != std::errc() || std::abs(exponent) > 100000) return std::nullopt;
  }
  const std::string moved = digits.substr(0, at) + "e" + std::to_string(exponent + power);
  double value = 0;
  const auto [end, error] = std::from_chars(moved.data(), moved.data() + moved.size(), value);
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

double apply(const cv_converter* converter, const WrittenNumber& number) {
  const double offset = cv_convert_double(converter, 0.0);
  const double factor = cv_convert_double(converter, 1.0);
  const double power = std::round(std::log10(factor));
  // UDUNITS multiplies its prefixes out, which leaves a few units in the last place.
  constexpr double round_off = 1e-14;
  const bool decimal = offset == 0 && std::abs(factor / std::pow(10.0, power) - 1) < round_off;
  const auto exact = decimal ? move_decimal_point(number.digits, static_cast<int>(power)) : std::nullopt;
  return exact ? *exact : cv_convert_double(converter, number.value);
}

double convert(std::string_view text, const WrittenNumber& number, std::string_view unit) {
  const std::scoped_lock lock(udunits_mutex());
  const Unit from = parse_unit(number.unit);
  const Unit to = parse_unit(unit);
  const std::string quoted = "'" + std::string(text) + "'";
  if (!to) throw InputError("'" + std::string(unit) + "' is not a unit that UDUNITS-2 knows");
  if (!from) {
    throw InputError(quoted + ": '" + number.unit + "' is not a unit that UDUNITS-2 knows; expected " +
                     expectation(unit));
  }
  if (!same_dimension(from.get(), to.get())) {
    throw InputError(quoted + " is " + dimension_name(from.get()) + " and cannot be converted to " +
                     (unit.empty() ? std::string("a pure number") : std::string(unit)));
  }
  const Converter converter(ut_get_converter(from.get(), to.get()));
  const double value = converter ? apply(converter.get(), number) : std::nan("");
  if (!std::isfinite(value)) throw InputError(quoted + " is not finite in " + std::string(unit));
  return value;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether an exponent's number begins at `at`.
bool is_exponent(std::string_view text, std::size_t at) {
  const std::size_t digit = at < text.size() && (text[at] == '+' || text[at] == '-') ? at + 1 : at;
  return digit < text.size() && is_digit(text[digit]);
}

/// Numbers that other programs write or read, and that end too early here: what follows would be taken for a unit (d is
/// a day, e the charge of an electron).
void refuse_other_spelling(std::string_view written, std::size_t used) {
  const std::string quoted = "'" + std::string(written) + "'";
  const std::string digits(written.substr(0, used));
  const std::string_view rest = written.substr(used);
  const auto meant = [&](std::size_t skip, const char* sign) {
    return "; write " + digits + sign + std::string(rest.substr(skip));
  };
  if (rest.size() > 1 && (rest[0] == 'd' || rest[0] == 'D') && is_exponent(rest, 1)) {
    throw InputError(quoted + ": an exponent as Fortran writes it" + meant(1, "e"));
  }
  if (rest.size() > 1 && rest[0] == ',' && is_digit(rest[1])) {
    throw InputError(quoted + ": a comma inside of the number" + meant(1, "."));
  }
  const auto letter = rest.find_first_not_of(' ');
  const bool apart = letter != 0 && letter != std::string_view::npos && (rest[letter] == 'e' || rest[letter] == 'E');
  if (apart && is_exponent(rest, letter + 1)) {
    throw InputError(quoted + ": a blank inside of the number" + meant(letter + 1, "e"));
  }
}

}  // namespace

std::optional<WrittenNumber> split_number(std::string_view text) {
  const std::string_view written = trim(text);
  std::string_view digits = written;
  if (digits.starts_with('+') && digits.size() > 1 && digits[1] != '-' && digits[1] != '+') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range || !std::isfinite(value)) {
    throw InputError("'" + std::string(written) + "' is not a finite number");
  }
  const auto used = static_cast<std::size_t>(end - digits.data());
  refuse_other_spelling(digits, used);
  return WrittenNumber{value, std::string(digits.substr(0, used)), std::string(trim(digits.substr(used)))};
}

double parse_quantity(std::string_view text, std::string_view unit) {
  const auto number = split_number(text);
  if (!number) throw InputError("'" + std::string(trim(text)) + "' is not a number; expected " + expectation(unit));
  if (number->unit.empty() || number->unit == unit) return number->value;
  return convert(trim(text), *number, unit);
}

bool is_unit(std::string_view unit) {
  const std::scoped_lock lock(udunits_mutex());
  return parse_unit(unit) != nullptr;
}

}  // namespace grainstep::units
