/// @file Grains are worked on block by block, each by one thread. What the blocks are follows from the number of grains
/// alone, so that sums over blocks, and with them all results, do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/team.hpp"

namespace grainstep::dem::native {

struct Blocks {
  std::int32_t grains = 0;  ///< those that are awake
  std::int32_t size = 1;

  [[nodiscard]] std::int32_t count() const { return (grains + size - 1) / size; }
  [[nodiscard]] std::int32_t first(std::int32_t block) const { return block * size; }
  [[nodiscard]] std::int32_t last(std::int32_t block) const { return std::min(grains, (block + 1) * size); }
  [[nodiscard]] std::int32_t of(std::int32_t grain) const { return grain / size; }
};

/// Small blocks share work well, large ones have fewer pairs with grains of others.
inline std::int32_t block_size(std::int32_t grains) {
  std::int32_t size = 2048;
  while (size < grains / 64) size *= 2;
  return size;
}

}  // namespace grainstep::dem::native
