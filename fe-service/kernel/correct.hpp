/// @file From the elastic predictor of a batch to its stress, per material. `state` holds the predictor.
#pragma once

#include "fe-service/kernel/batch.hpp"
#include "fe-service/materials/radial_return.hpp"

namespace grainstep::fe {
namespace {

/// What the return needs to know besides the predictor, per triangle.
struct Flow {
  double volume[kBatchTriangles];     ///< m^3, at the middle of the step
  double old_work[kBatchTriangles];   ///< rotated old deviator : deviator of the predictor, Pa^2
  double increment[kBatchTriangles];  ///< plastic strain increment
  double work[kBatchTriangles];       ///< J
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

/// Solves the local problem of all lanes that yield. False: some lane did not converge.
inline bool solve_return(const Dh36& law, const double* q, const double* plastic_strain, double* static_strength,
                         double log_rate_scale, double* increment) {
  alignas(kAlignment) double s[kBatchTriangles];
#pragma omp simd
  for (int i = 0; i < kBatchTriangles; ++i) {
    const bool yields = q[i] > static_strength[i] * (1.0 + kYieldTolerance);
    // A lane at rest gets an overshoot that is safe to compute with; its result is dropped.
    s[i] = return_start(law, yields ? q[i] : 2.0 * static_strength[i], plastic_strain[i], static_strength[i]);
  }
  for (int iteration = 0; iteration < kMaxReturnIterations; ++iteration) {
    double worst = 0.0;
    alignas(kAlignment) double strength[kBatchTriangles];
#pragma omp simd reduction(max : worst)
    for (int i = 0; i < kBatchTriangles; ++i) {
      const bool yields = q[i] > static_strength[i] * (1.0 + kYieldTolerance);
      const ReturnPoint point = return_step(law, q[i], plastic_strain[i], log_rate_scale, s[i]);
      const double error = yields ? std::abs(point.residual) - kYieldTolerance * q[i] : 0.0;
      worst = error > worst ? error : worst;
      increment[i] = yields ? point.increment : 0.0;
      strength[i] = yields ? point.static_strength : static_strength[i];
      s[i] = point.next;
    }
    if (worst <= 0.0) {
#pragma omp simd
      for (int i = 0; i < kBatchTriangles; ++i) static_strength[i] = strength[i];
      return true;
    }
  }
  return false;
}

GS_ALWAYS_INLINE void return_lane(const Dh36& law, const double* q, double* state, Flow& flow, int i) {
  const double d = flow.increment[i];
  const Stress trial = stress_of(state, i);
  const Stress s = deviator(trial);
  const double p = mean(trial);
  const double inverse_q = 1.0 / (q[i] + 1e-300);                   // finite where there is neither stress nor flow
  const double scale = 1.0 - 3.0 * law.elastic.mu * d * inverse_q;  // exactly 1 without flow
  set_stress(state, i, {p + scale * s.xx, p + scale * s.yy, scale * s.xy, p + scale * s.zz});
  state[kPlasticStrain * kBatchTriangles + i] += d;
  flow.work[i] = 0.5 * (scale * q[i] + 1.5 * flow.old_work[i] * inverse_q) * d * flow.volume[i];
}

inline void correct(const Elastic&, double*, Flow&, double, int, RowSweep&) {}

/// Radial return. Plastic work is sum of (old + new stress)/2 : plastic strain increment x volume at the middle of the
/// step: the part of the trapezoidal internal work that the stored energy does not account for.
inline void correct(const Dh36& law, double* state, Flow& flow, double log_rate_scale, int lanes, RowSweep& row) {
  double* plastic_strain = state + kPlasticStrain * kBatchTriangles;
  double* static_strength = state + kStaticStrength * kBatchTriangles;
  alignas(kAlignment) double q[kBatchTriangles];
  double overshoot = 0.0;
#pragma omp simd reduction(max : overshoot)
  for (int i = 0; i < kBatchTriangles; ++i) {
    q[i] = von_mises(stress_of(state, i));
    const double found = q[i] - static_strength[i] * (1.0 + kYieldTolerance);
    overshoot = found > overshoot ? found : overshoot;
  }
  if (overshoot <= 0.0) return;
  ++row.yielding;
  if (!solve_return(law, q, plastic_strain, static_strength, log_rate_scale, flow.increment)) ++row.unconverged;
#pragma omp simd
  for (int i = 0; i < kBatchTriangles; ++i) return_lane(law, q, state, flow, i);
  for (int t = 0; t < kQuadTriangles; ++t) {
    for (int l = 0; l < lanes; ++l) row.plastic_work += flow.work[t * kBatchQuads + l];
  }
}

}  // namespace
}  // namespace grainstep::fe
