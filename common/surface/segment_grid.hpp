/// @file Which segments are near a point: a grid over the plane, rebuilt when the surface has moved.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/polyline.hpp"

namespace grainstep::surface {

/// After rebuild(surface, reach), near() finds all segments within `reach` of a point, in ascending order.
/// Memory is reused: rebuilding allocates only when the surface outgrows what it was.
class SegmentGrid {
 public:
  /// `reach` in m, above 0.
  void rebuild(const Polyline& surface, double reach);

  /// Appends the segments whose distance to p is less than `reach`.
  void near(const Polyline& surface, const Vec2& p, std::vector<std::uint32_t>& found) const;

  /// False: certainly no segment within reach of p. Cheap enough to ask of every particle.
  [[nodiscard]] bool covers(const Vec2& p) const {
    return p[0] >= low_[0] && p[0] <= high_[0] && p[1] >= low_[1] && p[1] <= high_[1];
  }

 private:
  struct CellRange {
    std::size_t column_begin, column_end, row_begin, row_end;
  };
  void fit(const Polyline& surface);
  void divide(std::size_t axis);
  void coarsen_for(const Polyline& surface);
  [[nodiscard]] CellRange cells_of(const Polyline& surface, std::uint32_t segment) const;
  [[nodiscard]] std::size_t index(double x, std::size_t axis) const;

  double reach_ = 0.0;
  Vec2 low_{{1.0, 1.0}};
  Vec2 high_{{-1.0, -1.0}};
  Vec2 cell_size_{{1.0, 1.0}};
  std::array<std::size_t, 2> cells_{1, 1};
  std::vector<std::uint32_t> begin_;  ///< first entry of each cell in segments_, and one past the last
  std::vector<std::uint32_t> segments_;
};

}  // namespace grainstep::surface
