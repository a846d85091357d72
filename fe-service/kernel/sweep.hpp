/// @file The element loop: one row of quads, eight at a time: kinematics and elastic predictor, correction by the
/// material, nodal forces. Measure and material are template parameters: there is no second copy of this loop.
#pragma once

#include "fe-service/kernel/batch.hpp"

namespace grainstep::fe {
namespace {

/// Whether the four triangles of a quad share their dilatation (measure.hpp). Where flow keeps no volume, nothing can
/// lock.
template <class Measure, class Law>
inline constexpr bool kShares = Measure::kSharesDilatation&& Law::kTraits.keeps_volume;

// The body of every lane loop is one call: GCC gives aggregates that are declared in the body of an `omp simd` loop a
// home in memory, which keeps it from vectorising; those of an inlined function become registers.

/// A triangle's increments over a step, and its volume at the middle of it.
struct Increments {
  StrainIncrement strain;
  double half_tangent;
  double volume;

  [[nodiscard]] GS_ALWAYS_INLINE double dilatation() const { return strain.xx + strain.yy + strain.zz; }
};

template <int T, class Measure>
GS_ALWAYS_INLINE Increments increments(const Batch& batch, const Measure& measure, double step, int l) {
  constexpr int next = (T + 1) % kQuadTriangles;
  const Vec2 moved_a = step * batch.rate(T, l);
  const Vec2 moved_b = step * batch.rate(next, l);
  const Vec2 middle_a = batch.arm(T, l) - 0.5 * moved_a;
  const Vec2 middle_b = batch.arm(next, l) - 0.5 * moved_b;
  const TriangleMotion m = motion(middle_a, middle_b, moved_a, moved_b);
  const double moved_x = step * batch.centre_u[l];
  const double x = batch.centre_x[l] - 0.5 * moved_x + (middle_a.x + middle_b.x) * (1.0 / 3.0);
  const double u = moved_x + (moved_a.x + moved_b.x) * (1.0 / 3.0);
  return {{m.xx, m.yy, m.gamma, measure.out_of_plane_increment(x, u)},
          m.half_tangent,
          0.5 * m.twice_area * measure.thickness(x)};
}

/// Mean dilatation of a quad, by volume.
template <class Measure>
GS_ALWAYS_INLINE void dilate_lane(const Batch& batch, const Measure& measure, double step, double* mean, int l) {
  const Increments bottom = increments<0>(batch, measure, step, l);
  const Increments right = increments<1>(batch, measure, step, l);
  const Increments top = increments<2>(batch, measure, step, l);
  const Increments left = increments<3>(batch, measure, step, l);
  mean[l] = (bottom.volume * bottom.dilatation() + right.volume * right.dilatation() + top.volume * top.dilatation() +
             left.volume * left.dilatation()) /
            (bottom.volume + right.volume + top.volume + left.volume);
}

/// Rotates the old stress of triangle T and adds the elastic increment. Leaves the predictor in `state`.
template <int T, class Law, class Measure, class Memory>
GS_ALWAYS_INLINE void predict_lane(const Batch& batch, const Law& law, const Measure& measure, double step,
                                   const double* dilatation, double* state, Memory& flow, int l) {
  const int i = T * kBatchQuads + l;
  Increments now = increments<T>(batch, measure, step, l);
  if constexpr (kShares<Measure, Law>) {
    const double missing = (dilatation[l] - now.dilatation()) * (1.0 / 3.0);
    now.strain = {now.strain.xx + missing, now.strain.yy + missing, now.strain.gamma, now.strain.zz + missing};
  }
  const Stress old = rotate(stress_of(state, i), now.half_tangent);
  const Stress change = rotate_from_middle(law.elasticity().increment(now.strain), now.half_tangent);
  const Stress trial = {old.xx + change.xx, old.yy + change.yy, old.xy + change.xy, old.zz + change.zz};
  set_stress(state, i, trial);
  remember(flow, i, now.volume, old, trial, now.half_tangent);
}

template <int T, class Law, class Measure, class Memory>
GS_ALWAYS_INLINE void predict_triangle(const Batch& batch, const Law& law, const Measure& measure, double step,
                                       const double* dilatation, double* state, Memory& flow) {
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) predict_lane<T>(batch, law, measure, step, dilatation, state, flow, l);
}

template <class Law, class Measure, class Memory>
GS_ALWAYS_INLINE void predict(const Batch& batch, const Law& law, const Measure& measure, double step, double* state,
                              Memory& flow) {
  double dilatation[kBatchQuads];
  if constexpr (kShares<Measure, Law>) {
#pragma omp simd
    for (int l = 0; l < kBatchQuads; ++l) dilate_lane(batch, measure, step, dilatation, l);
  }
  predict_triangle<0>(batch, law, measure, step, dilatation, state, flow);
  predict_triangle<1>(batch, law, measure, step, dilatation, state, flow);
  predict_triangle<2>(batch, law, measure, step, dilatation, state, flow);
  predict_triangle<3>(batch, law, measure, step, dilatation, state, flow);
}

/// What a triangle's stress does to its outer nodes, N; that of x3 pulls all three nodes by `hoop`.
struct Pull {
  Vec2 on_a, on_b;
  double hoop;
  double twice_area;
};

template <int T, class Measure>
GS_ALWAYS_INLINE double twice_volume(const Batch& batch, const Measure& measure, int lane) {
  const Vec2 a = batch.arm(T, lane);
  const Vec2 b = batch.arm((T + 1) % kQuadTriangles, lane);
  return cross(a, b) * measure.thickness(batch.centre_x[lane] + (a.x + b.x) * (1.0 / 3.0));
}

/// Mean of a quad's mean stress, by volume: what works on its mean dilatation.
template <class Measure>
GS_ALWAYS_INLINE double quad_mean(const Batch& batch, const Measure& measure, const double* state, int lane) {
  const double bottom = twice_volume<0>(batch, measure, lane);
  const double right = twice_volume<1>(batch, measure, lane);
  const double top = twice_volume<2>(batch, measure, lane);
  const double left = twice_volume<3>(batch, measure, lane);
  return (bottom * mean(stress_of(state, lane)) + right * mean(stress_of(state, kBatchQuads + lane)) +
          top * mean(stress_of(state, 2 * kBatchQuads + lane)) +
          left * mean(stress_of(state, 3 * kBatchQuads + lane))) /
         (bottom + right + top + left);
}

template <int T, class Measure>
GS_ALWAYS_INLINE Pull pull_of(const Batch& batch, const Measure& measure, const Stress& stress, int lane) {
  const Vec2 a = batch.arm(T, lane);
  const Vec2 b = batch.arm((T + 1) % kQuadTriangles, lane);
  const double thickness = measure.thickness(batch.centre_x[lane] + (a.x + b.x) * (1.0 / 3.0));
  const double twice_area = cross(a, b);
  Pull found = {-thickness * traction(stress, b), thickness * traction(stress, a), 0.0, twice_area};
  if constexpr (Measure::kHoops) {
    found.hoop = measure.hoop_pull(stress.zz, twice_area);
    found.on_a.x -= found.hoop;
    found.on_b.x -= found.hoop;
  }
  return found;
}

/// `shared`: quad_mean().
template <int T, class Law, class Measure>
GS_ALWAYS_INLINE Pull pull(const Batch& batch, const Measure& measure, const double* state, double shared, int lane) {
  Stress stress = stress_of(state, T * kBatchQuads + lane);
  if constexpr (kShares<Measure, Law>) {
    const double change = shared - mean(stress);
    stress = {stress.xx + change, stress.yy + change, stress.xy, stress.zz + change};
  }
  return pull_of<T>(batch, measure, stress, lane);
}

/// Rows of corner contributions, so that neighbouring batches need not wait for each other's stores.
struct Contributions {
  double* left_x;  ///< lane i: to node i
  double* left_y;
  double* right_x;  ///< lane i: to node i+1
  double* right_y;
};

/// A quad's four triangles, counter-clockwise from the bottom.
struct QuadPull {
  Pull bottom, right, top, left;
};

/// Corner contributions of the quad at `at`. Returns the force on its centre.
template <class Measure>
GS_ALWAYS_INLINE Vec2 contribute(const QuadPull& quad, const Contributions& upper, const Contributions& lower, int at) {
  const Vec2 lower_left = quad.bottom.on_a + quad.left.on_b;
  const Vec2 lower_right = quad.right.on_a + quad.bottom.on_b;
  const Vec2 upper_right = quad.top.on_a + quad.right.on_b;
  const Vec2 upper_left = quad.left.on_a + quad.top.on_b;
  lower.left_x[at] = lower_left.x;
  lower.left_y[at] = lower_left.y;
  lower.right_x[at] = lower_right.x;
  lower.right_y[at] = lower_right.y;
  upper.right_x[at] = upper_right.x;
  upper.right_y[at] = upper_right.y;
  upper.left_x[at] = upper_left.x;
  upper.left_y[at] = upper_left.y;
  Vec2 centre = {-(lower_left.x + lower_right.x + upper_right.x + upper_left.x),
                 -(lower_left.y + lower_right.y + upper_right.y + upper_left.y)};
  // In the plane, forces add up to zero; of the hoops' each node has the same.
  if constexpr (Measure::kHoops) {
    centre.x -= 3.0 * (quad.bottom.hoop + quad.right.hoop + quad.top.hoop + quad.left.hoop);
  }
  return centre;
}

template <class Law, class Measure>
GS_ALWAYS_INLINE void force_lane(const Batch& batch, const Measure& measure, const double* state, int first,
                                 const Contributions& upper, const Contributions& lower, double* min_twice_area,
                                 double* centre_x, double* centre_y, int l) {
  double shared = 0.0;
  if constexpr (kShares<Measure, Law>) shared = quad_mean(batch, measure, state, l);
  const QuadPull quad = {pull<0, Law>(batch, measure, state, shared, l), pull<1, Law>(batch, measure, state, shared, l),
                         pull<2, Law>(batch, measure, state, shared, l),
                         pull<3, Law>(batch, measure, state, shared, l)};
  const double area_1 = quad.bottom.twice_area < quad.right.twice_area ? quad.bottom.twice_area : quad.right.twice_area;
  const double area_2 = quad.top.twice_area < quad.left.twice_area ? quad.top.twice_area : quad.left.twice_area;
  const double area = area_1 < area_2 ? area_1 : area_2;
  min_twice_area[l] = area < min_twice_area[l] ? area : min_twice_area[l];
  const Vec2 centre = contribute<Measure>(quad, upper, lower, first + l);
  centre_x[l] = centre.x;
  centre_y[l] = centre.y;
}

/// Internal forces (they pull back: minus the gradient of the strain energy) with the geometry at the end of the step.
template <class Law, class Measure>
GS_ALWAYS_INLINE void add_forces(const Batch& batch, const Measure& measure, const double* state, int first,
                                 const Contributions& upper, const Contributions& lower, RowSweep& row,
                                 double* min_twice_area) {
  // Centre forces go straight to their row, which is padded to whole batches (with zero mass inverse).
  double* centre_x = row.centre_force.x + first;
  double* centre_y = row.centre_force.y + first;
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) {
    force_lane<Law>(batch, measure, state, first, upper, lower, min_twice_area, centre_x, centre_y, l);
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
GS_ALWAYS_INLINE Contributions contributions(double* scratch, int quads, int which) {
  double* rows[4];
  for (int r = 0; r < 4; ++r) {
    rows[r] = scratch + static_cast<std::size_t>(4 * which + r) * scratch_row(quads) + kBatchQuads;
    rows[r][-1] = 0.0;
  }
  return {rows[0], rows[1], rows[2], rows[3]};
}

GS_ALWAYS_INLINE void finish_upper_row(RowSweep& row, bool set) {
  const Contributions upper = contributions(row.scratch, row.quads, 0);
  assemble(row.upper_force.x, upper.left_x, upper.right_x, row.quads, set);
  assemble(row.upper_force.y, upper.left_y, upper.right_y, row.quads, set);
}

template <class Law, class Measure>
void sweep_row(RowSweep& row, const Law& law, const Measure& measure) {
  const Contributions upper = contributions(row.scratch, row.quads, 0);
  const Contributions lower = contributions(row.scratch, row.quads, 1);
  const double parameter = law.step_parameter(row.step);
  double min_twice_area[kBatchQuads];
  for (double& area : min_twice_area) area = 1e300;
  double plastic_work[kBatchQuads] = {};
  row.plastic_work = 0.0;
  row.stored = 0.0;
  row.yielding = 0;
  row.unconverged = 0;
  alignas(kAlignment) Batch batch;
  alignas(kAlignment) typename Law::Memory flow;
  double* state = row.state;
  for (int first = 0; first < row.quads; first += kBatchQuads) {
    load(row, first, batch);
    predict(batch, law, measure, row.step, state, flow);
    correct(law, state, flow, parameter, lanes_of(row, first), plastic_work, row);
    add_forces<Law>(batch, measure, state, first, upper, lower, row, min_twice_area);
    state += Law::kTraits.state * kBatchTriangles;
  }
  for (const double work : plastic_work) row.plastic_work += work;
  row.min_twice_area = min_twice_area[0];
  for (const double area : min_twice_area) row.min_twice_area = area < row.min_twice_area ? area : row.min_twice_area;
  if (!row.leave_upper) finish_upper_row(row, row.first_row);
  assemble(row.lower_force.x, lower.left_x, lower.right_x, row.quads, true);
  assemble(row.lower_force.y, lower.left_y, lower.right_y, row.quads, true);
}

}  // namespace
}  // namespace grainstep::fe
