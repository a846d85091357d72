/// @file From the elastic predictor of a batch to its stress, sandwich core.
#pragma once

#include <cstddef>

#include "fe-service/materials/core.hpp"

namespace grainstep::fe {

/// Local problems of a batch, in the material frame.
struct CoreReturn {
  double cos2[kBatchTriangles], sin2[kBatchTriangles];  ///< of twice the angle of the material axes
  double trial_xx[kBatchTriangles], trial_yy[kBatchTriangles];
  double trial_xy[kBatchTriangles], trial_zz[kBatchTriangles];           ///< Pa
  double xx[kBatchTriangles], yy[kBatchTriangles], zz[kBatchTriangles];  ///< plastic strain increments

  [[nodiscard]] GS_ALWAYS_INLINE Stress trial(int i) const {
    return {trial_xx[i], trial_yy[i], trial_xy[i], trial_zz[i]};
  }
};

/// Turns the material axes and looks at the predictor in them. Returns how far it is beyond the strength.
GS_ALWAYS_INLINE double turn_lane(const Core& law, const FullMemory& flow, double* state, int i, CoreReturn& local) {
  const double t = flow.half_tangent[i];
  const double scale = 1.0 / (1.0 + t * t);
  const double cosine = (1.0 - t * t) * scale;
  const double sine = 2.0 * t * scale;
  const double old_cosine = state[kAxisCosine * kBatchTriangles + i];
  const double old_sine = state[kAxisSine * kBatchTriangles + i];
  const double c = old_cosine * cosine - old_sine * sine;
  const double s = old_sine * cosine + old_cosine * sine;
  state[kAxisCosine * kBatchTriangles + i] = c;
  state[kAxisSine * kBatchTriangles + i] = s;
  local.cos2[i] = c * c - s * s;
  local.sin2[i] = 2.0 * c * s;
  const Stress trial = turned(stress_of(state, i), local.cos2[i], -local.sin2[i]);
  local.trial_xx[i] = trial.xx;
  local.trial_yy[i] = trial.yy;
  local.trial_xy[i] = trial.xy;
  local.trial_zz[i] = trial.zz;
  local.xx[i] = 0.0;
  local.yy[i] = 0.0;
  local.zz[i] = 0.0;
  return core_overshoot(law, trial, state[kCompaction * kBatchTriangles + i]);
}

/// Returns by how much the lane misses the tolerance, at most 0 when it is done.
GS_ALWAYS_INLINE double sweep_core_lane(const Core& law, const double* compaction, double drag, int i,
                                        CoreReturn& local) {
  CoreFlowIncrement x = {local.xx[i], local.yy[i], local.zz[i], 0.0};
  const Stress trial = local.trial(i);
  const double change = sweep_core(law, trial, compaction[i], drag, x);
  local.xx[i] = x.xx;
  local.yy[i] = x.yy;
  local.zz[i] = x.zz;
  return change - kCoreTolerance * core_scale(law, trial);
}

GS_ALWAYS_INLINE bool solve_core(const Core& law, const double* compaction, double drag, CoreReturn& local) {
  for (int sweep = 0; sweep < kMaxCoreSweeps; ++sweep) {
    double worst = 0.0;
#pragma omp simd reduction(max : worst)
    for (int i = 0; i < kBatchTriangles; ++i) {
      const double miss = sweep_core_lane(law, compaction, drag, i, local);
      worst = miss > worst ? miss : worst;
    }
    if (worst <= 0.0) return true;
  }
  return false;
}

/// Returns the work of the plastic strains, J.
GS_ALWAYS_INLINE double core_lane(const Core& law, const CoreReturn& local, const FullMemory& flow, double drag,
                                  double* state, int i) {
  const Stress trial = local.trial(i);
  const CoreFlowIncrement x = {local.xx[i], local.yy[i], local.zz[i], shear_increment(law, trial.xy, drag)};
  const Stress now = relaxed(law, trial, x);
  const Stress before =
      turned({flow.old_xx[i], flow.old_yy[i], flow.old_xy[i], flow.old_zz[i]}, local.cos2[i], -local.sin2[i]);
  set_stress(state, i, turned(now, local.cos2[i], local.sin2[i]));
  state[kCompaction * kBatchTriangles + i] -= x.yy;
  return 0.5 * flow.volume[i] *
         ((before.xx + now.xx) * x.xx + (before.yy + now.yy) * x.yy + (before.zz + now.zz) * x.zz +
          (before.xy + now.xy) * x.gamma);
}

/// As for DH36; `drag` = eta/dt.
GS_ALWAYS_INLINE void correct(const Core& law, double* state, const FullMemory& flow, double drag, int lanes,
                              double* work, RowOutcome& row) {
  alignas(kAlignment) CoreReturn local;
  double overshoot = 0.0;
#pragma omp simd reduction(max : overshoot)
  for (int i = 0; i < kBatchTriangles; ++i) {
    const double found = turn_lane(law, flow, state, i, local);
    overshoot = found > overshoot ? found : overshoot;
  }
  if (overshoot <= 0.0) return;
  ++row.yielding;
  row.unconverged += solve_core(law, state + std::ptrdiff_t{kCompaction} * kBatchTriangles, drag, local) ? 0 : 1;
  alignas(kAlignment) double done[kBatchTriangles];
#pragma omp simd
  for (int i = 0; i < kBatchTriangles; ++i) done[i] = core_lane(law, local, flow, drag, state, i);
  for (int t = 0; t < kQuadTriangles; ++t) {
    for (int l = 0; l < lanes; ++l) work[l] += done[t * kBatchQuads + l];
  }
}

}  // namespace grainstep::fe
