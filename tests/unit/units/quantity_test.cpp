#include "units/quantity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <thread>
#include <vector>

#include "base/error.hpp"

namespace grainstep::units {
namespace {

using testing::HasSubstr;

std::string message_of(const std::string& text, const std::string& unit) {
  try {
    static_cast<void>(parse_quantity(text, unit));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

struct Case {
  const char* text;
  const char* unit;
  double si;
};

/// Names the case in the test's output.
void PrintTo(const Case& written, std::ostream* out) { *out << written.text; }

class Quantity : public testing::TestWithParam<Case> {};

TEST_P(Quantity, ConvertsToSi) {
  const auto& [text, unit, si] = GetParam();
  // Round-off of one multiplication by a factor that is itself rounded.
  EXPECT_NEAR(parse_quantity(text, unit), si, 4 * std::numeric_limits<double>::epsilon() * std::abs(si)) << text;
}

INSTANTIATE_TEST_SUITE_P(AsPeopleWriteThem, Quantity,
                         testing::Values(Case{"200 um", "m", 200e-6}, Case{"7300 kN/m", "N/m", 7.3e6},
                                         Case{"2700 kg/m^3", "kg/m^3", 2700}, Case{"400 m/s", "m/s", 400},
                                         Case{"50 mm", "m", 0.05}, Case{"470 MPa", "Pa", 470e6},
                                         Case{"200 GPa", "Pa", 200e9}, Case{"1 s-1", "1/s", 1},
                                         Case{"24.1 ns", "s", 24.1e-9}, Case{"2.7 g/cm3", "kg/m^3", 2700},
                                         Case{"200um", "m", 200e-6}, Case{"200 µm", "m", 200e-6},
                                         Case{"  -3.5e2 mm ", "m", -0.35}, Case{"+2 m", "m", 2}, Case{"50 %", "", 0.5},
                                         Case{"0.25", "m", 0.25}, Case{"1e-9", "", 1e-9}, Case{"3 1/s", "1/s", 3}));

TEST(Quantity, ABareNumberAndTheOwnUnitAreExact) {
  EXPECT_EQ(parse_quantity("0.1", "m"), 0.1);
  EXPECT_EQ(parse_quantity("0.1 m", "m"), 0.1);
  EXPECT_EQ(parse_quantity("7300000.1 N/m", "N/m"), 7300000.1);
}

TEST(Quantity, DecimalPrefixesAreExact) {
  EXPECT_EQ(parse_quantity("200 um", "m"), 0.0002);
  EXPECT_EQ(parse_quantity("0.2 mm", "m"), 0.0002);
  EXPECT_EQ(parse_quantity("2e2 um", "m"), 0.0002);
  EXPECT_EQ(parse_quantity("2.E+2 um", "m"), 0.0002);
  EXPECT_EQ(parse_quantity("24.1 ns", "s"), 2.41e-8);
  EXPECT_EQ(parse_quantity("2.7 g/cm3", "kg/m^3"), 2700);
  EXPECT_EQ(parse_quantity("470 MPa", "Pa"), 4.7e8);
  EXPECT_EQ(parse_quantity("0e99999999999 um", "m"), 0);
  EXPECT_DOUBLE_EQ(parse_quantity("1 inch", "m"), 0.0254);
  EXPECT_DOUBLE_EQ(parse_quantity("20 degC", "K"), 293.15);
  EXPECT_DOUBLE_EQ(parse_quantity("180 deg", "rad"), 3.14159265358979323846);
}

TEST(QuantityErrors, NameTheTextItsDimensionAndTheExpectedUnit) {
  EXPECT_EQ(message_of("200 um/s", "m"), "'200 um/s' is a speed and cannot be converted to m");
  EXPECT_EQ(message_of("3 m", ""), "'3 m' is a length and cannot be converted to a pure number");
  EXPECT_EQ(message_of("3 m.kg", "m"), "'3 m.kg' is a quantity in m.kg and cannot be converted to m");
  EXPECT_EQ(message_of("3 metrs", "m"),
            "'3 metrs': 'metrs' is not a unit that UDUNITS-2 knows; expected a number with a unit of m");
  EXPECT_EQ(message_of("thick", "m"), "'thick' is not a number; expected a number with a unit of m");
  EXPECT_EQ(message_of("", "m"), "'' is not a number; expected a number with a unit of m");
}

TEST(QuantityErrors, AnAngleIsNoPureNumber) {
  EXPECT_EQ(message_of("35 deg", ""), "'35 deg' is an angle and cannot be converted to a pure number");
  EXPECT_EQ(message_of("0.6 rad", ""), "'0.6 rad' is an angle and cannot be converted to a pure number");
  EXPECT_EQ(message_of("10 %", "rad"), "'10 %' is a pure number and cannot be converted to rad");
  EXPECT_EQ(message_of("10 deg/s", "1/s"), "'10 deg/s' is an angular speed and cannot be converted to 1/s");
  EXPECT_DOUBLE_EQ(parse_quantity("10 deg", "rad"), 3.14159265358979323846 / 18);
  EXPECT_EQ(parse_quantity("0.3", "rad"), 0.3);
  EXPECT_EQ(parse_quantity("70 percent", ""), 0.7);
  EXPECT_EQ(parse_quantity("30 Hz", "1/s"), 30);
}

TEST(QuantityErrors, NumbersAsOtherProgramsWriteThem) {
  EXPECT_EQ(message_of("1.0d-3 s", "s"), "'1.0d-3 s': an exponent as Fortran writes it; write 1.0e-3 s");
  EXPECT_EQ(message_of("1D3", "m"), "'1D3': an exponent as Fortran writes it; write 1e3");
  EXPECT_EQ(message_of("1d+3 m", "m"), "'1d+3 m': an exponent as Fortran writes it; write 1e+3 m");
  EXPECT_EQ(message_of("1,5 m", "m"), "'1,5 m': a comma inside of the number; write 1.5 m");
  EXPECT_EQ(message_of("1.0 e-3 m", "m"), "'1.0 e-3 m': a blank inside of the number; write 1.0e-3 m");
  EXPECT_EQ(parse_quantity("2d", "s"), 172800);
  EXPECT_DOUBLE_EQ(parse_quantity("1 d-1", "1/s"), 1.0 / 86400);
}

TEST(QuantityErrors, APeriodIsNotARate) { EXPECT_THAT(message_of("2 s", "1/s"), HasSubstr("is a time")); }

TEST(QuantityErrors, NotFiniteIsRefused) {
  for (const auto* const text : {"nan", "inf", "-inf", "nan m", "infinity m", "1e999", "1e999 m", "1e308 Gm"}) {
    EXPECT_THAT(message_of(text, "m"), HasSubstr("not")) << text;
    EXPECT_THAT(message_of(text, "m"), HasSubstr("finite")) << text;
  }
}

TEST(QuantityErrors, AUnitIsAName) {
  for (const auto* const text : {"100 200 um", "3 - m", "5 m @ 3", "5 s since 1970-01-01", "5 s from 3"}) {
    EXPECT_THAT(message_of(text, "m"), HasSubstr("is not a unit")) << text;
  }
  EXPECT_THAT(message_of("1 " + std::string(10000, '('), "m"), HasSubstr("is not a unit"));
}

TEST(Quantity, ManyThreadsAgree) {
  std::vector<double> results(8, 0);
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (auto& result : results) {
    threads.emplace_back([&result] {
      for (int i = 0; i < 200; ++i) result += parse_quantity("3 mm", "m");
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_THAT(results, testing::Each(results.front()));
  EXPECT_GT(results.front(), 0.59);
}

}  // namespace
}  // namespace grainstep::units
