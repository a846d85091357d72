#include "dem-service/native/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace grainstep::dem::native {
namespace {

/// Cells cost something even where nothing is in them.
constexpr double most_cells_per_grain = 16.0;

}  // namespace

template <int D>
void Neighbours<D>::lay_cells(const Grains<D>& grains, std::int32_t active) {
  double low[3] = {0.0, 0.0, 0.0};
  double high[3] = {0.0, 0.0, 0.0};
  std::copy_n(grains.position(0), D, low);
  std::copy_n(grains.position(0), D, high);
  double sum = 0.0;  // of no use but to see what is not a number, which min and max pass over
  for (std::ptrdiff_t i = 0; i < active; ++i) {
    for (int c = 0; c < D; ++c) {
      low[c] = std::min(low[c], grains.position(i)[c]);
      high[c] = std::max(high[c], grains.position(i)[c]);
      sum += grains.position(i)[c];
    }
  }
  if (!std::isfinite(sum)) {
    throw NumericalError(
        "a particle is nowhere: its position is not a number; the computation is unstable; take shorter steps "
        "(steps.impactor)");
  }
  double size = 2.0 * (grains.largest_radius() + allowance_.slow);
  double extent = 0.0;
  while (true) {
    double cells = 1.0;
    for (int c = 0; c < D; ++c) {
      extent = std::max(extent, high[c] - low[c]);
      const double along = std::floor((high[c] - low[c]) / size) + 1.0;
      cells_.number[c] = static_cast<std::int32_t>(std::min(along, 1e6));
      cells *= along;
    }
    if (cells <= std::max(1000.0, most_cells_per_grain * active)) break;
    size *= 1.25;
  }
  std::copy_n(low, 3, cells_.low);
  cells_.per_size = 1.0 / size;
  // Places are rounded when they are made, and again when they are subtracted, squared and compared.
  slack_ = static_cast<float>(8.0 * std::numeric_limits<float>::epsilon() * (extent + 4.0 * size));
}

template <int D>
void Neighbours<D>::sort(Grains<D>& grains, std::int32_t active, const std::vector<std::uint8_t>& fast) {
  const std::int32_t cells = cells_.count();
  slow_begin_.assign(static_cast<std::size_t>(cells) + 1, 0);
  fast_begin_.assign(static_cast<std::size_t>(cells) + 1, 0);
  cell_of_.resize(static_cast<std::size_t>(active));
  for (std::int32_t i = 0; i < active; ++i) {
    std::int32_t cell = 0;
    for (int c = D - 1; c >= 0; --c) {
      const auto at = static_cast<std::int32_t>((grains.position(i)[c] - cells_.low[c]) * cells_.per_size);
      cell = cell * cells_.number[c] + std::clamp(at, 0, cells_.number[c] - 1);
    }
    cell_of_[static_cast<std::size_t>(i)] = cell;
    ++(fast[static_cast<std::size_t>(i)] != 0 ? fast_begin_ : slow_begin_)[static_cast<std::size_t>(cell) + 1];
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(cells); ++c) slow_begin_[c + 1] += slow_begin_[c];
  slow_ = slow_begin_.back();
  fast_begin_.front() = slow_;
  for (std::size_t c = 0; c < static_cast<std::size_t>(cells); ++c) fast_begin_[c + 1] += fast_begin_[c];
  order_.resize(static_cast<std::size_t>(active));
  for (std::int32_t i = active - 1; i >= 0; --i) {  // backwards, so that a cell keeps the order that it had
    const auto n = static_cast<std::size_t>(i);
    auto& begin = (fast[n] != 0 ? fast_begin_ : slow_begin_)[static_cast<std::size_t>(cell_of_[n]) + 1];
    order_[static_cast<std::size_t>(--begin)] = i;
  }
  // Every begin now stands one cell further on.
  const auto back = [](std::vector<std::int32_t>& begin, std::int32_t end) {
    std::rotate(begin.begin(), begin.begin() + 1, begin.end());
    begin.back() = end;
  };
  back(slow_begin_, slow_);
  back(fast_begin_, active);
  grains.reorder(order_);
}

template <int D>
std::int32_t Neighbours<D>::begin_of(const std::vector<std::int32_t>& begin, int x, int y, int z) const {
  const std::ptrdiff_t row = std::ptrdiff_t{z} * cells_.number[1] + y;
  return begin[static_cast<std::size_t>(row * cells_.number[0] + x)];
}

template <int D>
void Neighbours<D>::look(const Grains<D>& grains, std::int32_t grain, std::int32_t first, std::int32_t last) {
  if (first >= last) return;
  const auto room = static_cast<std::size_t>(count_ + (last - first)) + lanes_at_once;
  if (pairs_.size() < room) pairs_.resize(2 * room);
  count_ += sweeps_.near[D - 2]({grains.places(), reach_.data(), grain, first, last}, pairs_.data() + count_);
}

/// Half of the cells around, so that every pair is found once.
template <int D>
void Neighbours<D>::find_slow(const Grains<D>& grains) {
  const std::int32_t* n = cells_.number;
  for (std::int32_t z = 0; z < n[2]; ++z) {
    for (std::int32_t y = 0; y < n[1]; ++y) {
      for (std::int32_t x = 0; x < n[0]; ++x) {
        const std::int32_t begin = begin_of(slow_begin_, x, y, z);
        const std::int32_t end = begin_of(slow_begin_, x + 1, y, z);
        if (begin == end) continue;
        const std::int32_t left = std::max(x - 1, 0);
        const std::int32_t right = std::min(x + 2, n[0]);
        std::int32_t ranges[5][2];
        int count = 0;
        const auto add = [&](std::int32_t row, std::int32_t layer, std::int32_t from) {
          if (row < 0 || row >= n[1] || layer >= n[2]) return;
          ranges[count][0] = begin_of(slow_begin_, from, row, layer);
          ranges[count++][1] = begin_of(slow_begin_, right, row, layer);
        };
        add(y + 1, z, left);
        if constexpr (D == 3) {
          for (int row = y - 1; row <= y + 1; ++row) add(row, z + 1, left);
        }
        const std::int32_t last = begin_of(slow_begin_, right, y, z);
        for (std::int32_t i = begin; i < end; ++i) {
          begin_of_grain_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(count_);
          look(grains, i, i + 1, last);
          for (int r = 0; r < count; ++r) look(grains, i, ranges[r][0], ranges[r][1]);
        }
      }
    }
  }
}

template <int D>
void Neighbours<D>::find_fast(const Grains<D>& grains, std::int32_t active) {
  const double reach = 2.0 * (grains.largest_radius() + allowance_.fast + 2.0 * slack_);
  const auto cells = static_cast<std::int32_t>(std::ceil(reach * cells_.per_size));
  for (std::int32_t i = slow_; i < active; ++i) {
    begin_of_grain_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(count_);
    std::int32_t at[3] = {0, 0, 0};
    for (int c = 0; c < D; ++c) {
      const auto cell = static_cast<std::int32_t>((grains.position(i)[c] - cells_.low[c]) * cells_.per_size);
      at[c] = std::clamp(cell, 0, cells_.number[c] - 1);
    }
    const std::int32_t left = std::max(at[0] - cells, 0);
    const std::int32_t right = std::min(at[0] + cells + 1, cells_.number[0]);
    const std::int32_t high = std::min(at[2] + cells, cells_.number[2] - 1);
    for (std::int32_t z = std::max(at[2] - cells, 0); z <= high; ++z) {
      const std::int32_t top = std::min(at[1] + cells, cells_.number[1] - 1);
      for (std::int32_t y = std::max(at[1] - cells, 0); y <= top; ++y) {
        look(grains, i, begin_of(slow_begin_, left, y, z), begin_of(slow_begin_, right, y, z));
        look(grains, i, std::max(i + 1, begin_of(fast_begin_, left, y, z)), begin_of(fast_begin_, right, y, z));
      }
    }
  }
}

template <int D>
void Neighbours<D>::rebuild(Grains<D>& grains, std::int32_t active, const std::vector<std::uint8_t>& fast) {
  count_ = 0;
  inner_.count = 0;
  slow_ = 0;
  order_.clear();
  if (active == 0) return;
  lay_cells(grains, active);
  sort(grains, active, fast);
  grains.set_origin(cells_.low, active);
  const auto size = static_cast<std::size_t>(active);
  reach_.resize(size + lanes_at_once);
  inner_reach_.resize(size);
  for (std::int32_t i = 0; i < active; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const bool slow = i < slow_;
    reach_[n] = static_cast<float>(grains.radius(i) + (slow ? allowance_.slow : allowance_.fast)) + 2.0F * slack_;
    const double inner = slow ? inner_allowance_.slow : inner_allowance_.fast;
    inner_reach_[n] = static_cast<float>(grains.radius(i) + inner) + slack_;
  }
  begin_of_grain_.resize(size + 1);
  find_slow(grains);
  find_fast(grains, active);
  begin_of_grain_[size] = static_cast<std::int32_t>(count_);
  refresh(grains);
}

template <int D>
void Neighbours<D>::refresh(const Grains<D>& grains) {
  const auto room = static_cast<std::size_t>(count_) + lanes_at_once;
  if (inner_.number.size() < room) {
    inner_.number.resize(room + room / 2);
    inner_.pair.resize(room + room / 2);
  }
  const std::ptrdiff_t found = sweeps_.touching[D - 2](
      {grains.places(), pairs_.data(), nullptr, count_, 0.0F, inner_reach_.data(), 0.0F}, inner_.number.data());
  inner_.count = static_cast<std::size_t>(found);
  for (std::size_t n = 0; n < inner_.count; ++n) inner_.pair[n] = pairs_[inner_.number[n]];
}

template <int D>
std::int32_t Neighbours<D>::find(std::int32_t i, std::int32_t j) const {
  const std::int32_t end = begin_of_grain_[static_cast<std::size_t>(i) + 1];
  for (std::int32_t k = begin_of_grain_[static_cast<std::size_t>(i)]; k < end; ++k) {
    if (pairs_[static_cast<std::size_t>(k)].second == j) return k;
  }
  return -1;
}

template class Neighbours<2>;
template class Neighbours<3>;

}  // namespace grainstep::dem::native
