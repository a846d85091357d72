/// @file The mesh of a layered beam or circular plate: nx x ny quads, each four crossed triangles, x2 = 0 at the loaded
/// face and the structure below it. Of a plate it is a half section: x1 is the radius, column 0 the axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fe-service/kernel/layout.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::fe {

/// Throws InputError where so many quads are more than any machine of today finishes, a typing error rather than a
/// wish, or do not fit into this one's memory: the system would end whoever asks for that without a word. `key`: the
/// scene's, that asks for them, with its value.
void require_fits(double quads, const std::string& key);

struct ElementRow {
  int layer;         ///< index into the scene's layers
  double height;     ///< m
  double quad_area;  ///< m^2, undeformed
};

/// A corner node by row and column.
struct Corner {
  int row, column;
};

struct Mesh {
  double left;                   ///< x1 of column 0, m
  double length;                 ///< m
  double width;                  ///< of a quad, m
  double element_size;           ///< asked for, m
  bool symmetric;                ///< column 0 is the plane or axis of symmetry; else it is clamped
  int columns;                   ///< quads along x1, nx
  int mid_column;                ///< corner column at x1 = 0
  std::vector<ElementRow> rows;  ///< from the loaded face to the back face
  std::vector<double> level;     ///< x2 of every row of corners, rows + 1

  [[nodiscard]] int row_count() const { return static_cast<int>(rows.size()); }
  [[nodiscard]] std::uint64_t triangles() const { return 4ULL * columns * rows.size(); }
  [[nodiscard]] std::uint64_t nodes() const { return (columns + 1ULL) * (rows.size() + 1) + columns * rows.size(); }
  [[nodiscard]] std::size_t corner_stride() const { return centre_stride() + kBatchQuads; }
  [[nodiscard]] std::size_t centre_stride() const {
    return static_cast<std::size_t>((columns + kBatchQuads - 1) / kBatchQuads) * kBatchQuads;
  }
  [[nodiscard]] std::size_t batches() const { return centre_stride() / kBatchQuads; }
  [[nodiscard]] std::size_t corner(Corner c) const { return c.row * corner_stride() + c.column; }
  [[nodiscard]] Corner middle_of_face() const { return {0, (columns + 1) / 2}; }
  [[nodiscard]] double corner_x(int column) const { return left + length * column / columns; }

  /// The touchable surface as a chain of corners, left to right, the structure on its right-hand side: (left end face,
  /// full span only,) loaded face, end face. Consecutive corners are its segments.
  [[nodiscard]] std::vector<Corner> surface() const;
};

/// Elements have the size h/refinement, h half the thickness of a single layer; of several layers, the first one's
/// thickness/refinement. Counts are rounded up, so that span and thickness are met exactly.
/// Throws InputError where an element would be larger than a layer is thick, or the mesh too large to be meant.
[[nodiscard]] Mesh make_mesh(const scene::Structure& structure);

}  // namespace grainstep::fe
