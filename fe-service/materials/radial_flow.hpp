/// @file From the elastic predictor of a batch to its stress, per material. `state` holds the predictor. All of it is
/// inlined into every copy of the element loop: a function that copies share is fused differently by the compiler, and
/// another measure would change the last bits of plane strain.
#pragma once

#include "fe-service/kernel/batch.hpp"
#include "fe-service/materials/radial_return.hpp"

namespace grainstep::fe {
namespace {

/// What the return needs to know besides the predictor, per triangle.
struct Flow {
  double volume[kBatchTriangles];    ///< m^3, at the middle of the step
  double old_work[kBatchTriangles];  ///< rotated old deviator : deviator of the predictor, Pa^2
};

GS_ALWAYS_INLINE Stress stress_of(const double* state, int i) {
  return {state[kXX * kBatchTriangles + i], state[kYY * kBatchTriangles + i], state[kXY * kBatchTriangles + i],
          state[kZZ * kBatchTriangles + i]};
}

GS_ALWAYS_INLINE void set_stress(double* state, int i, const Stress& s) {
  state[kXX * kBatchTriangles + i] = s.xx;
  state[kYY * kBatchTriangles + i] = s.yy;
  state[kXY * kBatchTriangles + i] = s.xy;
  state[kZZ * kBatchTriangles + i] = s.zz;
}

GS_ALWAYS_INLINE void remember(Flow& flow, int i, double volume, const Stress& old, const Stress& trial, double) {
  flow.volume[i] = volume;
  flow.old_work[i] = contract(deviator(old), deviator(trial));
}

/// The local problems of a batch. A lane at rest gets numbers that are safe to compute with, and none of them is kept.
/// No flags: arrays of another size than double's keep GCC from vectorising.
struct Return {
  double q[kBatchTriangles];          ///< of the predictor, Pa
  double overshoot[kBatchTriangles];  ///< of q over the strength before, Pa; above 0: the lane yields
  double s[kBatchTriangles];          ///< ln d
  double d[kBatchTriangles];          ///< plastic strain increment
  double strength[kBatchTriangles];   ///< static strength at the end, Pa
};

/// A lane starts from its last increment, which is seldom far off, or from the bound if that is smaller. Returns the
/// overshoot of a lane without a last one, else 0.
GS_ALWAYS_INLINE double start_lane(const Dh36& law, const double* strength, const double* last, int i, Return& local) {
  const double over = local.overshoot[i];
  const double before = last[i];
  const double largest = largest_increment(law, over > 0.0 ? local.q[i] : 2.0 * strength[i], strength[i]);
  const double chosen = before < largest ? before : largest;
  local.d[i] = before > 0.0 ? chosen : largest;
  return before > 0.0 ? 0.0 : over;
}

GS_ALWAYS_INLINE void first_start_lane(const Dh36& law, const double* plastic_strain, const double* strength,
                                       const double* last, int i, Return& local) {
  const double over = local.overshoot[i];
  const double before = local.d[i];
  const double found =
      first_increment(law, over > 0.0 ? local.q[i] : 2.0 * strength[i], plastic_strain[i], strength[i]);
  local.d[i] = last[i] > 0.0 ? before : found;
}

/// Returns by how much the lane misses the tolerance, at most 0 when it is done.
GS_ALWAYS_INLINE double return_step_lane(const Dh36& law, const double* plastic_strain, double log_rate_scale, int i,
                                         Return& local) {
  const double q = local.q[i];
  const double over = local.overshoot[i];
  const ReturnPoint point = return_step(law, q, plastic_strain[i], log_rate_scale, local.s[i], local.d[i]);
  local.s[i] += point.step;
  local.d[i] *= std::exp(point.step);
  local.strength[i] = point.static_strength;
  return over > 0.0 ? point.error - kYieldTolerance * q : 0.0;
}

/// Solves the local problem of all lanes that yield. False: some lane did not converge.
GS_ALWAYS_INLINE bool solve_return(const Dh36& law, const double* plastic_strain, const double* strength,
                                   const double* last, double log_rate_scale, Return& local) {
  double first = 0.0;
#pragma omp simd reduction(max : first)
  for (int i = 0; i < kBatchTriangles; ++i) {
    const double found = start_lane(law, strength, last, i, local);
    first = found > first ? found : first;
  }
  if (first > 0.0) {
#pragma omp simd
    for (int i = 0; i < kBatchTriangles; ++i) first_start_lane(law, plastic_strain, strength, last, i, local);
  }
#pragma omp simd
  for (int i = 0; i < kBatchTriangles; ++i) local.s[i] = std::log(local.d[i]);
  for (int iteration = 0; iteration < kMaxReturnIterations; ++iteration) {
    double worst = 0.0;
#pragma omp simd reduction(max : worst)
    for (int i = 0; i < kBatchTriangles; ++i) {
      const double miss = return_step_lane(law, plastic_strain, log_rate_scale, i, local);
      worst = miss > worst ? miss : worst;
    }
    if (worst <= 0.0) return true;
  }
  return false;
}

/// Returns the plastic work, J.
GS_ALWAYS_INLINE double return_lane(const Dh36& law, const Return& local, const Flow& flow, double* state, int i) {
  const bool yields = local.overshoot[i] > 0.0;
  const double found = local.d[i];
  const double new_strength = local.strength[i];
  const double old_strength = state[kStaticStrength * kBatchTriangles + i];
  const double last = state[kLastIncrement * kBatchTriangles + i];
  const double d = yields ? found : 0.0;
  const double q = local.q[i];
  const Stress trial = stress_of(state, i);
  const Stress s = deviator(trial);
  const double p = mean(trial);
  const double inverse_q = 1.0 / (q + 1e-300);                      // finite where there is neither stress nor flow
  const double scale = 1.0 - 3.0 * law.elastic.mu * d * inverse_q;  // exactly 1 without flow
  set_stress(state, i, {p + scale * s.xx, p + scale * s.yy, scale * s.xy, p + scale * s.zz});
  state[kPlasticStrain * kBatchTriangles + i] += d;
  state[kStaticStrength * kBatchTriangles + i] = yields ? new_strength : old_strength;
  state[kLastIncrement * kBatchTriangles + i] = yields ? found : last;
  return 0.5 * (scale * q + 1.5 * flow.old_work[i] * inverse_q) * d * flow.volume[i];
}

inline void correct(const Elastic&, double*, const Flow&, double, int, double*, RowSweep&) {}

/// Radial return; adds the plastic work of the first `lanes` quads to `work`. That is the sum of (old + new stress)/2 :
/// plastic strain increment x volume at the middle of the step: the part of the trapezoidal internal work that the
/// stored energy does not account for.
GS_ALWAYS_INLINE void correct(const Dh36& law, double* state, const Flow& flow, double log_rate_scale, int lanes,
                              double* work, RowSweep& row) {
  const double* strength = state + kStaticStrength * kBatchTriangles;
  alignas(kAlignment) Return local;
  double overshoot = 0.0;
#pragma omp simd reduction(max : overshoot)
  for (int i = 0; i < kBatchTriangles; ++i) {
    const double q = von_mises(stress_of(state, i));
    const double found = q - strength[i] * (1.0 + kYieldTolerance);
    local.q[i] = q;
    local.overshoot[i] = found;
    overshoot = found > overshoot ? found : overshoot;
  }
  if (overshoot <= 0.0) return;
  ++row.yielding;
  const bool solved = solve_return(law, state + kPlasticStrain * kBatchTriangles, strength,
                                   state + kLastIncrement * kBatchTriangles, log_rate_scale, local);
  row.unconverged += solved ? 0 : 1;
  alignas(kAlignment) double done[kBatchTriangles];
#pragma omp simd
  for (int i = 0; i < kBatchTriangles; ++i) done[i] = return_lane(law, local, flow, state, i);
  for (int t = 0; t < kQuadTriangles; ++t) {
    for (int l = 0; l < lanes; ++l) work[l] += done[t * kBatchQuads + l];
  }
}

}  // namespace
}  // namespace grainstep::fe
