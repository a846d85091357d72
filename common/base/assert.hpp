/// @file Assertions with values, active in every build. A failed one is our bug: it ends the process.
#pragma once

#include <string>

namespace grainstep {

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line, const std::string& values);

}  // namespace grainstep

/// GS_ASSERT(condition, text): `text` is any expression that makes a std::string, evaluated only on failure.
#define GS_ASSERT(condition, text)                                           \
  do {                                                                       \
    if (!(condition)) {                                                      \
      ::grainstep::assertion_failed(#condition, __FILE__, __LINE__, (text)); \
    }                                                                        \
  } while (false)
