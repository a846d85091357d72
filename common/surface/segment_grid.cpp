#include "surface/segment_grid.hpp"

#include <algorithm>
#include <cmath>

namespace grainstep::surface {

void SegmentGrid::fit(const Polyline& surface) {
  low_ = high_ = surface.nodes().front();
  for (const Vec2& node : surface.nodes()) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low_[axis] = std::min(low_[axis], node[axis]);
      high_[axis] = std::max(high_[axis], node[axis]);
    }
  }
  low_ -= Vec2{{reach_, reach_}};
  high_ += Vec2{{reach_, reach_}};
  // Cells of about the reach, but never many more than segments: an empty cell costs as much as a full one.
  const double most_cells = 8.0 * static_cast<double>(surface.segment_count()) + 64.0;
  const double width = high_[0] - low_[0];
  const double height = high_[1] - low_[1];
  const double size = std::max(reach_, std::sqrt(width * height / most_cells));
  for (std::size_t axis = 0; axis < 2; ++axis) {
    // A surface that is long one way and thin the other has no more of them either, nor one whose nodes are anywhere.
    cells_[axis] = static_cast<std::size_t>(std::max(1.0, std::min(most_cells, (high_[axis] - low_[axis]) / size)));
    divide(axis);
  }
}

void SegmentGrid::divide(std::size_t axis) {
  cell_size_[axis] = (high_[axis] - low_[axis]) / static_cast<double>(cells_[axis]);
}

// Segments that all reach across the whole surface would be in all cells: as many entries as their number squared. Then
// larger cells are no worse, down to a single one that holds every segment once.
void SegmentGrid::coarsen_for(const Polyline& surface) {
  const std::uint64_t most = 64 * (surface.segment_count() + 64);
  const auto entries = [&] {
    std::uint64_t sum = 0;
    for (std::uint32_t i = 0; i < surface.segment_count() && sum <= most; ++i) {
      const CellRange range = cells_of(surface, i);
      sum += std::uint64_t{range.row_end - range.row_begin} * (range.column_end - range.column_begin);
    }
    return sum;
  };
  while (cells_[0] * cells_[1] > 1 && entries() > most) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      cells_[axis] = std::max<std::size_t>(1, cells_[axis] / 2);
      divide(axis);
    }
  }
}

std::size_t SegmentGrid::index(double x, std::size_t axis) const {
  const double last = static_cast<double>(cells_[axis] - 1);
  const double cell = std::max(0.0, (x - low_[axis]) / cell_size_[axis]);
  return static_cast<std::size_t>(std::min(last, cell));
}

SegmentGrid::CellRange SegmentGrid::cells_of(const Polyline& surface, std::uint32_t segment) const {
  const auto [first, second] = surface.segment(segment);
  const Vec2& a = surface.nodes()[first];
  const Vec2& b = surface.nodes()[second];
  return {index(std::min(a[0], b[0]) - reach_, 0), index(std::max(a[0], b[0]) + reach_, 0) + 1,
          index(std::min(a[1], b[1]) - reach_, 1), index(std::max(a[1], b[1]) + reach_, 1) + 1};
}

void SegmentGrid::rebuild(const Polyline& surface, double reach) {
  reach_ = reach;
  fit(surface);
  coarsen_for(surface);
  const auto for_each_cell = [&](std::uint32_t segment, auto&& visit) {
    const CellRange range = cells_of(surface, segment);
    for (std::size_t row = range.row_begin; row < range.row_end; ++row) {
      for (std::size_t column = range.column_begin; column < range.column_end; ++column) {
        visit(row * cells_[0] + column);
      }
    }
  };
  // Counting sort: how many per cell, where each cell ends, then fill from the back so that order stays ascending.
  const auto count = static_cast<std::uint32_t>(surface.segment_count());
  begin_.assign(cells_[0] * cells_[1] + 1, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    for_each_cell(i, [&](std::size_t cell) { ++begin_[cell]; });
  }
  std::uint32_t total = 0;
  for (std::uint32_t& entry : begin_) entry = (total += entry);
  segments_.resize(total);
  for (std::uint32_t i = count; i-- > 0;) {
    for_each_cell(i, [&](std::size_t cell) { segments_[--begin_[cell]] = i; });
  }
}

void SegmentGrid::near(const Polyline& surface, const Vec2& p, std::vector<std::uint32_t>& found) const {
  if (!covers(p)) return;
  const std::size_t cell = index(p[1], 1) * cells_[0] + index(p[0], 0);
  for (std::uint32_t entry = begin_[cell]; entry < begin_[cell + 1]; ++entry) {
    const std::uint32_t segment = segments_[entry];
    if (surface.squared_distance(p, segment) < reach_ * reach_) found.push_back(segment);
  }
}

}  // namespace grainstep::surface
