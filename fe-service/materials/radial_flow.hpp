/// @file From the elastic predictors of a batch to its stresses where flow is along the predictor's deviator (J2). For
/// any law whose local problem is given at a point, by three functions beside it (radial_return.hpp has DH36's):
///     return_step(law, q, plastic_strain, parameter, s, d)                one step of the local iteration in s = ln d
///     largest_increment(law, q, static_strength)                          where it may begin
///     first_increment(law, q, plastic_strain, static_strength)            the same at first yield
/// and whose state is that of RadialComponent.
#pragma once

#include <concepts>
#include <cstddef>

#include "fe-service/materials/radial_return.hpp"

namespace grainstep::fe {

template <class Law>
concept FlowsRadially = requires(const Law& law, double x) {
  { return_step(law, x, x, x, x, x) } -> std::same_as<ReturnPoint>;
  { largest_increment(law, x, x) } -> std::same_as<double>;
  { first_increment(law, x, x, x) } -> std::same_as<double>;
};

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
template <FlowsRadially Law>
GS_ALWAYS_INLINE double start_lane(const Law& law, const double* strength, const double* last, int i, Return& local) {
  const double over = local.overshoot[i];
  const double before = last[i];
  const double largest = largest_increment(law, over > 0.0 ? local.q[i] : 2.0 * strength[i], strength[i]);
  const double chosen = before < largest ? before : largest;
  local.d[i] = before > 0.0 ? chosen : largest;
  return before > 0.0 ? 0.0 : over;
}

template <FlowsRadially Law>
GS_ALWAYS_INLINE void first_start_lane(const Law& law, const double* plastic_strain, const double* strength,
                                       const double* last, int i, Return& local) {
  const double over = local.overshoot[i];
  const double before = local.d[i];
  const double found =
      first_increment(law, over > 0.0 ? local.q[i] : 2.0 * strength[i], plastic_strain[i], strength[i]);
  local.d[i] = last[i] > 0.0 ? before : found;
}

/// Returns by how much the lane misses the tolerance, at most 0 when it is done.
template <FlowsRadially Law>
GS_ALWAYS_INLINE double return_step_lane(const Law& law, const double* plastic_strain, double parameter, int i,
                                         Return& local) {
  const double q = local.q[i];
  const double over = local.overshoot[i];
  const ReturnPoint point = return_step(law, q, plastic_strain[i], parameter, local.s[i], local.d[i]);
  local.s[i] += point.step;
  local.d[i] *= std::exp(point.step);
  local.strength[i] = point.static_strength;
  return over > 0.0 ? point.error - kYieldTolerance * q : 0.0;
}

/// Solves the local problem of all lanes that yield. False: some lane did not converge.
template <FlowsRadially Law>
GS_ALWAYS_INLINE bool solve_return(const Law& law, const double* plastic_strain, const double* strength,
                                   const double* last, double parameter, Return& local) {
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
      const double miss = return_step_lane(law, plastic_strain, parameter, i, local);
      worst = miss > worst ? miss : worst;
    }
    if (worst <= 0.0) return true;
  }
  return false;
}

/// Returns the plastic work, J.
template <FlowsRadially Law>
GS_ALWAYS_INLINE double return_lane(const Law& law, const Return& local, const RadialMemory& flow, double* state,
                                    int i) {
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

/// Radial return; adds the plastic work of the first `lanes` quads to `work`. That is the sum of (old + new stress)/2 :
/// plastic strain increment x volume at the middle of the step: the part of the trapezoidal internal work that the
/// stored energy does not account for.
template <FlowsRadially Law>
GS_ALWAYS_INLINE void correct(const Law& law, double* state, const RadialMemory& flow, double parameter, int lanes,
                              double* work, RowOutcome& row) {
  const double* strength = state + std::ptrdiff_t{kStaticStrength} * kBatchTriangles;
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
  const bool solved = solve_return(law, state + std::ptrdiff_t{kPlasticStrain} * kBatchTriangles, strength,
                                   state + std::ptrdiff_t{kLastIncrement} * kBatchTriangles, parameter, local);
  row.unconverged += solved ? 0 : 1;
  alignas(kAlignment) double done[kBatchTriangles];
#pragma omp simd
  for (int i = 0; i < kBatchTriangles; ++i) done[i] = return_lane(law, local, flow, state, i);
  for (int t = 0; t < kQuadTriangles; ++t) {
    for (int l = 0; l < lanes; ++l) work[l] += done[t * kBatchQuads + l];
  }
}

}  // namespace grainstep::fe
