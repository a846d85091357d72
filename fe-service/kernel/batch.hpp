/// @file Eight quads side by side, read from a row. Only kernel.cpp includes this: everything is local to its copy.
#pragma once

#include "fe-service/kernel/kernel.hpp"
#include "fe-service/triangle.hpp"

namespace grainstep::fe {
namespace {

struct Batch {
  // Corners relative to the centre, counter-clockwise from the lower left.
  double arm_x[4][kBatchQuads], arm_y[4][kBatchQuads];    ///< m, at the end of the step
  double rate_u[4][kBatchQuads], rate_v[4][kBatchQuads];  ///< m/s, velocities relative to the centre's
  double centre_x[kBatchQuads], centre_u[kBatchQuads];

  [[nodiscard]] GS_ALWAYS_INLINE Vec2 arm(int corner, int lane) const {
    return {arm_x[corner][lane], arm_y[corner][lane]};
  }
  [[nodiscard]] GS_ALWAYS_INLINE Vec2 rate(int corner, int lane) const {
    return {rate_u[corner][lane], rate_v[corner][lane]};
  }
};

/// Quads of the batch that starts at `first`.
GS_ALWAYS_INLINE int lanes_of(const RowSweep& row, int first) {
  return row.quads - first < kBatchQuads ? row.quads - first : kBatchQuads;
}

GS_ALWAYS_INLINE void load_corner(const NodeRow& nodes, const NodeRow& centre, int node, int quad, Batch& batch,
                                  int corner, int lane) {
  batch.arm_x[corner][lane] = nodes.x[node] - centre.x[quad];
  batch.arm_y[corner][lane] = nodes.y[node] - centre.y[quad];
  batch.rate_u[corner][lane] = nodes.u[node] - centre.u[quad];
  batch.rate_v[corner][lane] = nodes.v[node] - centre.v[quad];
}

GS_ALWAYS_INLINE void load_quad(const RowSweep& row, int quad, Batch& batch, int lane) {
  load_corner(row.lower, row.centre, quad, quad, batch, 0, lane);
  load_corner(row.lower, row.centre, quad + 1, quad, batch, 1, lane);
  load_corner(row.upper, row.centre, quad + 1, quad, batch, 2, lane);
  load_corner(row.upper, row.centre, quad, quad, batch, 3, lane);
  batch.centre_x[lane] = row.centre.x[quad];
  batch.centre_u[lane] = row.centre.u[quad];
}

/// Lanes beyond the end of the row repeat the last quad: they live exactly its life, so that they neither yield nor
/// invert when it does not, and nothing of theirs is ever added up.
GS_ALWAYS_INLINE void load(const RowSweep& row, int first, Batch& batch) {
  if (lanes_of(row, first) == kBatchQuads) {
#pragma omp simd
    for (int l = 0; l < kBatchQuads; ++l) load_quad(row, first + l, batch, l);
  } else {
    for (int l = 0; l < kBatchQuads; ++l) load_quad(row, first + l < row.quads ? first + l : row.quads - 1, batch, l);
  }
}

}  // namespace
}  // namespace grainstep::fe
