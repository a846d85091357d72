#include "base/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace grainstep {
namespace {

TEST(NumberText, ReadsBackAsTheSameNumber) {
  for (const double value : {0.1, 1.0 / 3.0, 2.0 / 7.0, 24.1e-9, -4.7e8, 2.3e-308, 1.7976931348623157e308}) {
    EXPECT_EQ(std::stod(number_text(value)), value);
  }
  EXPECT_EQ(number_text(0.0002), "0.0002");
}

TEST(NumberText, IsRoundedForPeople) {
  EXPECT_EQ(rounded_text(1.0 / 3.0), "0.333333");
  EXPECT_EQ(rounded_text(1.23456e-7, 4), "1.235e-07");
  EXPECT_EQ(rounded_text(0.1, 99), "0.10000000000000001");
  EXPECT_EQ(metres(0.1), "0.1 m");
  EXPECT_EQ(figure(0.13694, 3), "0.137");
  EXPECT_EQ(figure(std::nan(""), 3), "-");
  EXPECT_EQ(figure(std::numeric_limits<double>::infinity(), 3), "-");
}

TEST(NumberText, TakesAPrefixAsPeopleWouldWriteIt) {
  EXPECT_EQ(prefixed_text(470e6, "Pa"), "470 MPa");
  EXPECT_EQ(prefixed_text(0.47, "Pa"), "470 mPa");
  EXPECT_EQ(prefixed_text(-86.4e6, "Pa"), "-86.4 MPa");
  EXPECT_EQ(prefixed_text(1e9, "Pa"), "1 GPa");
  EXPECT_EQ(prefixed_text(0.001, "m"), "1 mm");
  EXPECT_EQ(prefixed_text(24.1e-9, "s"), "24.1 ns");
  EXPECT_EQ(prefixed_text(7.3e6, "N/m"), "7.3 MN/m");
  EXPECT_EQ(prefixed_text(400, "m/s"), "400 m/s");
  EXPECT_EQ(prefixed_text(0, "m"), "0 m");
  EXPECT_EQ(prefixed_text(1e20, "Pa"), "1e+08 TPa");
  EXPECT_EQ(prefixed_text(2700, "kg/m^3"), "2700 kg/m^3");
  EXPECT_EQ(prefixed_text(1e-6, "1/s"), "1e-06 1/s");
  EXPECT_EQ(prefixed_text(35, ""), "35");
}

}  // namespace
}  // namespace grainstep
