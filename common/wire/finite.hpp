/// @file Numbers that came from somebody else must be numbers before they become a place, an index, or a result.
#pragma once

#include <google/protobuf/repeated_field.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "base/error.hpp"

namespace grainstep::wire {

/// NumericalError for the first value that is infinite or none: "`what` of window n: value i is nan. `advice`".
inline void require_finite(const std::string& what, std::uint64_t window,
                           const google::protobuf::RepeatedField<double>& values, const char* advice) {
  for (int i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    throw NumericalError(what + " of window " + std::to_string(window) + ": value " + std::to_string(i) + " is " +
                         std::to_string(values[i]) + ". " + advice);
  }
}

}  // namespace grainstep::wire
