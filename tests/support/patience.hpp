/// @file How long a test waits for what must come, in one place: CMake reads this number and tells it to the tests in
/// Python, and CTest's own limits are multiples of it (cmake/GrainstepTargets.cmake).
///
/// A test waits for conditions. One that never comes true fails the test, sooner or later; one that comes late on a
/// machine with ten times the work that it has cores must not.
#pragma once

#include <chrono>

namespace grainstep::testing {

inline constexpr std::chrono::seconds patience{300};

/// The same for poll(), and for options in seconds.
inline constexpr int patience_ms = std::chrono::milliseconds(patience).count();
inline constexpr double patience_s = patience.count();

/// The deadline of one wait that begins now.
[[nodiscard]] inline std::chrono::steady_clock::time_point soon() {
  return std::chrono::steady_clock::now() + patience;
}

}  // namespace grainstep::testing
