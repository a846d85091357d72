/// @file Bulk viscosity of one row of quads, after its sweep. A pass of its own, so that the element loop knows nothing
/// of it where it is off. The stress s I in all four triangles of a quad:
///     s = rho l (b_1 c_d d + b_2^2 l |d| min(0, d))
/// with d the quad's rate of volume at the middle of the step (the mean of its triangles' by volume), l the square root
/// of its area, rho its undeformed density and c_d^2 = (lambda + 2 mu)/rho. Linear term: Landshoff 1955; quadratic: von
/// Neumann and Richtmyer 1950; with the factors' meaning of Abaqus' user's manual.
#pragma once

#include "fe-service/kernel/sweep.hpp"

namespace grainstep::fe {
namespace {

/// Volume of a quad at the middle of the step, m^3, and its change in it.
struct VolumeChange {
  double volume, change;
};

template <class Measure>
GS_ALWAYS_INLINE VolumeChange volume_change(const Batch& batch, const Measure& measure, double step, int l) {
  const Increments bottom = increments<0>(batch, measure, step, l);
  const Increments right = increments<1>(batch, measure, step, l);
  const Increments top = increments<2>(batch, measure, step, l);
  const Increments left = increments<3>(batch, measure, step, l);
  return {bottom.volume + right.volume + top.volume + left.volume,
          bottom.volume * bottom.dilatation() + right.volume * right.dilatation() + top.volume * top.dilatation() +
              left.volume * left.dilatation()};
}

GS_ALWAYS_INLINE double quad_area(const Batch& batch, int l) {
  return 0.5 * (cross(batch.arm(0, l), batch.arm(1, l)) + cross(batch.arm(1, l), batch.arm(2, l)) +
                cross(batch.arm(2, l), batch.arm(3, l)) + cross(batch.arm(3, l), batch.arm(0, l)));
}

/// `stress`: of the step before, then of this one, Pa; `work` of this step, J; `viscosity`: largest ds/dd so far, Pa s.
template <class Measure>
GS_ALWAYS_INLINE void resist(const Batch& batch, const BulkViscosity& law, const Measure& measure, double step,
                             double* stress, double* work, double* viscosity, int l) {
  const VolumeChange quad = volume_change(batch, measure, step, l);
  const double rate = quad.change / (quad.volume * step);
  const double area = quad_area(batch, l);
  const double size = std::sqrt(area > 0.0 ? area : 0.0);
  const double squeezed = rate < 0.0 ? -rate : 0.0;
  const double excess = law.quadratic * size * squeezed;
  const double found = law.density * size * (law.linear_speed + excess) * rate;
  const double slope = law.density * size * (law.linear_speed + 2.0 * excess);
  work[l] = 0.5 * (stress[l] + found) * quad.change;
  viscosity[l] = slope > viscosity[l] ? slope : viscosity[l];
  stress[l] = found;
}

template <class Measure>
GS_ALWAYS_INLINE void resist_lane(const Batch& batch, const Measure& measure, double pressure, int at,
                                  const Contributions& upper, const Contributions& lower, double* centre_x,
                                  double* centre_y, int l) {
  const Stress stress = {pressure, pressure, 0.0, pressure};
  const QuadPull quad = {pull_of<0>(batch, measure, stress, l), pull_of<1>(batch, measure, stress, l),
                         pull_of<2>(batch, measure, stress, l), pull_of<3>(batch, measure, stress, l)};
  const Vec2 centre = contribute<Measure>(quad, upper, lower, at);
  centre_x[l] += centre.x;
  centre_y[l] += centre.y;
}

/// Adds the forces of a row to those that its sweep left.
template <class Measure>
void resist_row(RowSweep& row, const BulkViscosity& law, double* stress, const Measure& measure) {
  const Contributions upper = contributions(row.scratch, row.quads, 0);
  const Contributions lower = contributions(row.scratch, row.quads, 1);
  double viscosity[kBatchQuads] = {};
  alignas(kAlignment) Batch batch;
  row.viscous_work = 0.0;
  for (int first = 0; first < row.quads; first += kBatchQuads) {
    load(row, first, batch);
    double work[kBatchQuads];
    double* centre_x = row.centre_force.x + first;
    double* centre_y = row.centre_force.y + first;
    double* at = stress + first;
#pragma omp simd
    for (int l = 0; l < kBatchQuads; ++l) resist(batch, law, measure, row.step, at, work, viscosity, l);
#pragma omp simd
    for (int l = 0; l < kBatchQuads; ++l) {
      resist_lane(batch, measure, at[l], first + l, upper, lower, centre_x, centre_y, l);
    }
    for (int l = 0; l < lanes_of(row, first); ++l) row.viscous_work += work[l];
  }
  row.viscosity = 0.0;
  for (const double found : viscosity) row.viscosity = found > row.viscosity ? found : row.viscosity;
  if (!row.leave_upper) finish_upper_row(row, false);
  assemble(row.lower_force.x, lower.left_x, lower.right_x, row.quads, false);
  assemble(row.lower_force.y, lower.left_y, lower.right_y, row.quads, false);
}

}  // namespace
}  // namespace grainstep::fe
