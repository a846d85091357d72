/// @file Values of every type that somebody who means ill would try.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace grainstep::fuzz {

template <class Integer>
Integer extreme_integer(Integer now, std::mt19937_64& random) {
  using Limits = std::numeric_limits<Integer>;
  const std::array<Integer, 12> values{0,
                                       1,
                                       2,
                                       3,
                                       static_cast<Integer>(now + 1),
                                       static_cast<Integer>(now - 1),
                                       static_cast<Integer>(2 * (now / 2) + now / 2),
                                       static_cast<Integer>(1000000000),
                                       Limits::max(),
                                       static_cast<Integer>(Limits::max() - 1),
                                       static_cast<Integer>(Limits::max() / 2 + 1),
                                       static_cast<Integer>(random())};
  return values[random() % values.size()];
}

inline double extreme_double(double now, std::mt19937_64& random) {
  using Limits = std::numeric_limits<double>;
  const std::array<double, 24> values{0.0,
                                      -0.0,
                                      1.0,
                                      -1.0,
                                      0.5,
                                      2.0 * now,
                                      0.5 * now,
                                      -now,
                                      1e3 * now,
                                      1e-3 * now,
                                      std::nextafter(now, 2.0 * now),
                                      1e9,
                                      -1e9,
                                      1e15,
                                      1e-9,
                                      1e300,
                                      -1e300,
                                      1e-300,
                                      Limits::max(),
                                      Limits::denorm_min(),
                                      Limits::infinity(),
                                      -Limits::infinity(),
                                      Limits::quiet_NaN(),
                                      now + 1.0};
  return values[random() % values.size()];
}

inline std::string extreme_text(const std::string& now, std::mt19937_64& random) {
  switch (random() % 7) {
    case 0:
      return {};
    case 1:
      return std::string(1 + random() % 2000, 'a');
    case 2:
      return now + now;
    case 3:
      return "../../" + now;
    case 4:
      return std::string("\0\x1b[2J\n\"%s%n<&>", 14) + now;
    case 5:
      return "\xff\xfe" + now;  // no UTF-8
    default:
      return "deflection";
  }
}

}  // namespace grainstep::fuzz
