/// @file The element loop: one row of quads, eight at a time: kinematics and elastic predictor, correction by the
/// material, nodal forces. Measure and material are template parameters: there is no second copy of this loop.
#pragma once

#include "fe-service/kernel/correct_foam.hpp"

namespace grainstep::fe {
namespace {

inline const Elastic& elasticity(const Elastic& law) { return law; }
inline const Elastic& elasticity(const Dh36& law) { return law.elastic; }
inline const Elastic& elasticity(const Core& law) { return law.elastic; }
inline const Elastic& elasticity(const Foam& law) { return law.elastic; }

/// What the correction by a material keeps per triangle, and how large its state is.
template <class Law>
struct Correction {
  using Memory = Flow;
  static constexpr int kState = kPlasticState;
};
template <>
struct Correction<Elastic> {
  using Memory = Flow;
  static constexpr int kState = kElasticState;
};
template <>
struct Correction<Core> {
  using Memory = CoreFlow;
  static constexpr int kState = kCoreState;
};
template <>
struct Correction<Foam> {
  using Memory = CoreFlow;
  static constexpr int kState = kFoamState;
};

/// What a material wants to know of the step's length.
inline double step_parameter(const Elastic&, double) { return 0.0; }
inline double step_parameter(const Dh36& law, double step) { return std::log(step * law.reference_rate); }
inline double step_parameter(const Core& law, double step) { return law.viscosity / step; }
inline double step_parameter(const Foam& law, double step) { return law.viscosity / step; }

// The body of every lane loop is one call: GCC gives aggregates that are declared in the body of an `omp simd` loop a
// home in memory, which keeps it from vectorising; those of an inlined function become registers.

/// Rotates the old stress of triangle T and adds the elastic increment. Leaves the predictor in `state`.
template <int T, class Measure, class Memory>
GS_ALWAYS_INLINE void predict_lane(const Batch& batch, const Elastic& law, const Measure& measure, double step,
                                   double* state, Memory& flow, int l) {
  constexpr int next = (T + 1) % kQuadTriangles;
  const int i = T * kBatchQuads + l;
  const Vec2 moved_a = step * batch.rate(T, l);
  const Vec2 moved_b = step * batch.rate(next, l);
  const Vec2 middle_a = batch.arm(T, l) - 0.5 * moved_a;
  const Vec2 middle_b = batch.arm(next, l) - 0.5 * moved_b;
  const TriangleMotion m = motion(middle_a, middle_b, moved_a, moved_b);
  const double moved_x = step * batch.centre_u[l];
  const double x = batch.centre_x[l] - 0.5 * moved_x + (middle_a.x + middle_b.x) * (1.0 / 3.0);
  const double u = moved_x + (moved_a.x + moved_b.x) * (1.0 / 3.0);
  const Stress old = rotate(stress_of(state, i), m.half_tangent);
  const StrainIncrement strain{m.xx, m.yy, m.gamma, measure.out_of_plane_increment(x, u)};
  const Stress change = rotate_from_middle(law.increment(strain), m.half_tangent);
  const Stress trial = {old.xx + change.xx, old.yy + change.yy, old.xy + change.xy, old.zz + change.zz};
  set_stress(state, i, trial);
  remember(flow, i, 0.5 * m.twice_area * measure.thickness(x), old, trial, m.half_tangent);
}

template <int T, class Measure, class Memory>
GS_ALWAYS_INLINE void predict_triangle(const Batch& batch, const Elastic& law, const Measure& measure, double step,
                                       double* state, Memory& flow) {
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) predict_lane<T>(batch, law, measure, step, state, flow, l);
}

template <class Measure, class Memory>
GS_ALWAYS_INLINE void predict(const Batch& batch, const Elastic& law, const Measure& measure, double step,
                              double* state, Memory& flow) {
  predict_triangle<0>(batch, law, measure, step, state, flow);
  predict_triangle<1>(batch, law, measure, step, state, flow);
  predict_triangle<2>(batch, law, measure, step, state, flow);
  predict_triangle<3>(batch, law, measure, step, state, flow);
}

/// What a triangle's stress does to its outer nodes, N.
struct Pull {
  Vec2 on_a, on_b;
  double twice_area;
};

template <int T, class Measure>
GS_ALWAYS_INLINE Pull pull(const Batch& batch, const Measure& measure, const double* state, int lane) {
  const Vec2 a = batch.arm(T, lane);
  const Vec2 b = batch.arm((T + 1) % kQuadTriangles, lane);
  const double thickness = measure.thickness(batch.centre_x[lane] + (a.x + b.x) * (1.0 / 3.0));
  const Stress stress = stress_of(state, T * kBatchQuads + lane);
  return {-thickness * traction(stress, b), thickness * traction(stress, a), cross(a, b)};
}

/// Rows of corner contributions, so that neighbouring batches need not wait for each other's stores.
struct Contributions {
  double* left_x;  ///< lane i: to node i
  double* left_y;
  double* right_x;  ///< lane i: to node i+1
  double* right_y;
};

template <class Measure>
GS_ALWAYS_INLINE void force_lane(const Batch& batch, const Measure& measure, const double* state, int first,
                                 const Contributions& upper, const Contributions& lower, double* min_twice_area,
                                 double* centre_x, double* centre_y, int l) {
  const Pull bottom = pull<0>(batch, measure, state, l);
  const Pull right = pull<1>(batch, measure, state, l);
  const Pull top = pull<2>(batch, measure, state, l);
  const Pull left = pull<3>(batch, measure, state, l);
  const double area_1 = bottom.twice_area < right.twice_area ? bottom.twice_area : right.twice_area;
  const double area_2 = top.twice_area < left.twice_area ? top.twice_area : left.twice_area;
  const double area = area_1 < area_2 ? area_1 : area_2;
  min_twice_area[l] = area < min_twice_area[l] ? area : min_twice_area[l];
  const Vec2 lower_left = bottom.on_a + left.on_b;
  const Vec2 lower_right = right.on_a + bottom.on_b;
  const Vec2 upper_right = top.on_a + right.on_b;
  const Vec2 upper_left = left.on_a + top.on_b;
  lower.left_x[first + l] = lower_left.x;
  lower.left_y[first + l] = lower_left.y;
  lower.right_x[first + l] = lower_right.x;
  lower.right_y[first + l] = lower_right.y;
  upper.right_x[first + l] = upper_right.x;
  upper.right_y[first + l] = upper_right.y;
  upper.left_x[first + l] = upper_left.x;
  upper.left_y[first + l] = upper_left.y;
  centre_x[l] = -(lower_left.x + lower_right.x + upper_right.x + upper_left.x);
  centre_y[l] = -(lower_left.y + lower_right.y + upper_right.y + upper_left.y);
}

/// Internal forces (they pull back: minus the gradient of the strain energy) with the geometry at the end of the step.
template <class Measure>
GS_ALWAYS_INLINE void add_forces(const Batch& batch, const Measure& measure, const double* state, int first,
                                 const Contributions& upper, const Contributions& lower, RowSweep& row,
                                 double* min_twice_area) {
  // Centre forces go straight to their row, which is padded to whole batches (with zero mass inverse).
  double* centre_x = row.centre_force.x + first;
  double* centre_y = row.centre_force.y + first;
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) {
    force_lane(batch, measure, state, first, upper, lower, min_twice_area, centre_x, centre_y, l);
  }
}

/// Adds left and right contributions to nodes 0..quads, always in the same order.
GS_ALWAYS_INLINE void assemble(double* __restrict force, double* __restrict left, double* __restrict right, int quads,
                               bool set) {
  left[quads] = 0.0;
  const double* from_left_quad = right - 1;  // right[-1] is 0
  if (set) {
#pragma omp simd
    for (int i = 0; i <= quads; ++i) force[i] = left[i] + from_left_quad[i];
  } else {
#pragma omp simd
    for (int i = 0; i <= quads; ++i) force[i] += left[i] + from_left_quad[i];
  }
}

/// Cuts the scratch into rows, each with a zero in front.
inline Contributions contributions(double* scratch, int quads, int which) {
  double* rows[4];
  for (int r = 0; r < 4; ++r) {
    rows[r] = scratch + static_cast<std::size_t>(4 * which + r) * scratch_row(quads) + kBatchQuads;
    rows[r][-1] = 0.0;
  }
  return {rows[0], rows[1], rows[2], rows[3]};
}

template <class Law, class Measure>
void sweep_row(RowSweep& row, const Law& law, const Measure& measure) {
  const Contributions upper = contributions(row.scratch, row.quads, 0);
  const Contributions lower = contributions(row.scratch, row.quads, 1);
  const double parameter = step_parameter(law, row.step);
  double min_twice_area[kBatchQuads];
  for (double& area : min_twice_area) area = 1e300;
  double plastic_work[kBatchQuads] = {};
  row.plastic_work = 0.0;
  row.yielding = 0;
  row.unconverged = 0;
  alignas(kAlignment) Batch batch;
  alignas(kAlignment) typename Correction<Law>::Memory flow;
  double* state = row.state;
  for (int first = 0; first < row.quads; first += kBatchQuads) {
    load(row, first, batch);
    predict(batch, elasticity(law), measure, row.step, state, flow);
    correct(law, state, flow, parameter, lanes_of(row, first), plastic_work, row);
    add_forces(batch, measure, state, first, upper, lower, row, min_twice_area);
    state += Correction<Law>::kState * kBatchTriangles;
  }
  for (const double work : plastic_work) row.plastic_work += work;
  row.min_twice_area = min_twice_area[0];
  for (const double area : min_twice_area) row.min_twice_area = area < row.min_twice_area ? area : row.min_twice_area;
  assemble(row.upper_force.x, upper.left_x, upper.right_x, row.quads, row.first_row);
  assemble(row.upper_force.y, upper.left_y, upper.right_y, row.quads, row.first_row);
  assemble(row.lower_force.x, lower.left_x, lower.right_x, row.quads, true);
  assemble(row.lower_force.y, lower.left_y, lower.right_y, row.quads, true);
}

}  // namespace
}  // namespace grainstep::fe
