/// @file Grains sorted in space: cell by cell, so that those who may be near each other are ranges.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dem-service/native/grains.hpp"

namespace grainstep::dem::native {

/// The neighbours of a cell are the cells around it; grains that are fast look further.
template <int D>
class Cells {
 public:
  /// Sorts the first `active` grains: slow ones, cell by cell, then fast ones. `fast[i]`: which they are. `reach`: m,
  /// no further apart are the centres of slow ones that are looked for. Fills order(), which says for every place where
  /// its grain stood before. Throws NumericalError where a grain is nowhere.
  void sort(base::Team& team, Grains<D>& grains, std::int32_t active, const std::vector<std::uint8_t>& fast,
            double reach);

  [[nodiscard]] const std::vector<std::int32_t>& order() const { return order_; }
  [[nodiscard]] std::int32_t slow() const { return slow_; }  ///< how many
  [[nodiscard]] float slack() const { return slack_; }       ///< m, round-off of places

  /// What is asked for after sort(), and what the next order is followed from.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("slow grains", slow_);
    archive("round-off of places", slack_);
  }

  /// Calls use(i, ranges, count) for the slow grains of [first, last): half of the cells around, so that every pair is
  /// found once.
  template <typename Use>
  void each_slow(std::int32_t first, std::int32_t last, Use&& use) const {
    first = std::min(first, slow_);
    last = std::min(last, slow_);
    if (first == last) return;
    auto cell = static_cast<std::int32_t>(std::upper_bound(slow_begin_.begin(), slow_begin_.end(), first) -
                                          slow_begin_.begin()) -
                1;
    Range ranges[most_ranges];
    int count = around_slow(cell, ranges);
    for (std::int32_t i = first; i < last; ++i) {
      if (i >= slow_begin_[static_cast<std::size_t>(cell) + 1]) {
        while (i >= slow_begin_[static_cast<std::size_t>(cell) + 1]) ++cell;
        count = around_slow(cell, ranges);
      }
      ranges[0].first = i + 1;
      use(i, static_cast<const Range*>(ranges), count);
    }
  }

  /// Likewise of one fast grain: all slow ones around it, and those fast ones that stand behind it. `reach`: m, of
  /// centres. Ranges may be empty.
  template <typename Use>
  void around_fast(const Grains<D>& grains, std::int32_t grain, double reach, Use&& use) const {
    const auto cells = static_cast<std::int32_t>(std::ceil(reach * per_size_));
    std::int32_t at[3] = {0, 0, 0};
    for (int c = 0; c < D; ++c) at[c] = cell_along(grains.position(grain)[c], c);
    const std::int32_t left = std::max(at[0] - cells, 0);
    const std::int32_t right = std::min(at[0] + cells + 1, number_[0]);
    const std::int32_t high = std::min(at[2] + cells, number_[2] - 1);
    const std::int32_t top = std::min(at[1] + cells, number_[1] - 1);
    for (std::int32_t z = std::max(at[2] - cells, 0); z <= high; ++z) {
      for (std::int32_t y = std::max(at[1] - cells, 0); y <= top; ++y) {
        const Range ranges[2] = {
            {begin_of(slow_begin_, left, y, z), begin_of(slow_begin_, right, y, z)},
            {std::max(grain + 1, begin_of(fast_begin_, left, y, z)), begin_of(fast_begin_, right, y, z)}};
        use(static_cast<const Range*>(ranges), 2);
      }
    }
  }

 private:
  static constexpr int most_ranges = D == 2 ? 2 : 5;

  void lay(const Grains<D>& grains, std::int32_t active, double reach);
  /// The first range is the rest of the cell's own row.
  int around_slow(std::int32_t cell, Range* ranges) const;
  [[nodiscard]] std::int32_t count() const { return number_[0] * number_[1] * number_[2]; }
  [[nodiscard]] std::int32_t cell_along(double position, int c) const {
    const auto at = static_cast<std::int32_t>((position - low_[c]) * per_size_);
    return std::clamp(at, 0, number_[c] - 1);
  }
  [[nodiscard]] std::int32_t begin_of(const std::vector<std::int32_t>& begin, int x, int y, int z) const {
    const std::ptrdiff_t row = std::ptrdiff_t{z} * number_[1] + y;
    return begin[static_cast<std::size_t>(row * number_[0] + x)];
  }

  std::int32_t number_[3] = {1, 1, 1};
  double low_[3] = {0.0, 0.0, 0.0};
  double per_size_ = 0.0;
  std::vector<std::int32_t> cell_of_, order_, slow_begin_, fast_begin_;
  std::int32_t slow_ = 0;
  float slack_ = 0.0F;
};

}  // namespace grainstep::dem::native
