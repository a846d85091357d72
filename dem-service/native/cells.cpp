#include "dem-service/native/cells.hpp"

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace grainstep::dem::native {
namespace {

/// Cells cost something even where nothing is in them.
constexpr double most_cells_per_grain = 16.0;

}  // namespace

template <int D>
void Cells<D>::lay(const Grains<D>& grains, std::int32_t active, double reach) {
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
  double size = reach;
  double extent = 0.0;
  while (true) {
    double cells = 1.0;
    for (int c = 0; c < D; ++c) {
      extent = std::max(extent, high[c] - low[c]);
      const double along = std::floor((high[c] - low[c]) / size) + 1.0;
      number_[c] = static_cast<std::int32_t>(std::min(along, 1e6));
      cells *= along;
    }
    if (cells <= std::max(1000.0, most_cells_per_grain * active)) break;
    size *= 1.25;
  }
  std::copy_n(low, 3, low_);
  per_size_ = 1.0 / size;
  // Places are rounded when they are made, and again when they are subtracted, squared and compared.
  slack_ = static_cast<float>(8.0 * std::numeric_limits<float>::epsilon() * (extent + 4.0 * size));
}

template <int D>
void Cells<D>::sort(base::Team& team, Grains<D>& grains, std::int32_t active, const std::vector<std::uint8_t>& fast,
                    double reach) {
  order_.clear();
  slow_ = 0;
  if (active == 0) return;
  lay(grains, active, reach);
  const auto cells = static_cast<std::size_t>(count());
  slow_begin_.assign(cells + 1, 0);
  fast_begin_.assign(cells + 1, 0);
  cell_of_.resize(static_cast<std::size_t>(active));
  for (std::int32_t i = 0; i < active; ++i) {
    std::int32_t cell = 0;
    for (int c = D - 1; c >= 0; --c) cell = cell * number_[c] + cell_along(grains.position(i)[c], c);
    cell_of_[static_cast<std::size_t>(i)] = cell;
    ++(fast[static_cast<std::size_t>(i)] != 0 ? fast_begin_ : slow_begin_)[static_cast<std::size_t>(cell) + 1];
  }
  for (std::size_t c = 0; c < cells; ++c) slow_begin_[c + 1] += slow_begin_[c];
  slow_ = slow_begin_.back();
  fast_begin_.front() = slow_;
  for (std::size_t c = 0; c < cells; ++c) fast_begin_[c + 1] += fast_begin_[c];
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
  grains.reorder(team, order_);
  grains.set_origin(team, low_, active);
}

template <int D>
int Cells<D>::around_slow(std::int32_t cell, Range* ranges) const {
  const std::int32_t x = cell % number_[0];
  const std::int32_t y = cell / number_[0] % number_[1];
  const std::int32_t z = cell / number_[0] / number_[1];
  const std::int32_t left = std::max(x - 1, 0);
  const std::int32_t right = std::min(x + 2, number_[0]);
  int count = 0;
  ranges[count++] = {0, begin_of(slow_begin_, right, y, z)};
  const auto add = [&](std::int32_t row, std::int32_t layer) {
    if (row < 0 || row >= number_[1] || layer >= number_[2]) return;
    ranges[count++] = {begin_of(slow_begin_, left, row, layer), begin_of(slow_begin_, right, row, layer)};
  };
  add(y + 1, z);
  if constexpr (D == 3) {
    for (std::int32_t row = y - 1; row <= y + 1; ++row) add(row, z + 1);
  }
  return count;
}

template class Cells<2>;
template class Cells<3>;

}  // namespace grainstep::dem::native
