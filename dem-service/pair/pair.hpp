/// @file Two particles that may touch. Plain data: shared with files compiled for other instruction sets.
#pragma once

#include <cstdint>

namespace grainstep::dem {

/// By their numbers among the particles.
struct Pair {
  std::int32_t first, second;
};

}  // namespace grainstep::dem
