/// @file From the elastic predictor of a batch to its stress, foam.
#pragma once

#include "fe-service/materials/foam.hpp"

namespace grainstep::fe {

/// Local problems of a batch. A lane at rest gets numbers that are safe to compute with, and none of them is kept.
struct FoamReturn {
  double overshoot[kBatchTriangles];                               ///< above 0: the lane flows
  double deviatoric[kBatchTriangles], spherical[kBatchTriangles];  ///< of the predictor, Pa^2
  double room[kBatchTriangles];                                    ///< what is left of the plateau
  double x[kBatchTriangles];                                       ///< increment over stress, 1/Pa

  [[nodiscard]] GS_ALWAYS_INLINE FoamStress trial(int i) const { return {deviatoric[i], spherical[i]}; }
};

GS_ALWAYS_INLINE double look_lane(const Foam& law, const double* state, int i, FoamReturn& local) {
  const FoamStress trial = foam_stress(stress_of(state, i));
  const double strain = state[kFoamStrain * kBatchTriangles + i];
  const double over = foam_overshoot(law, trial, strain);
  local.overshoot[i] = over;
  local.deviatoric[i] = over > 0.0 ? trial.deviatoric : law.strength * law.strength;  // at rest: at the strength
  local.spherical[i] = over > 0.0 ? trial.spherical : 0.0;
  local.room[i] = over > 0.0 ? law.locked - strain : 1e300;
  local.x[i] = 0.0;
  return over;
}

/// Both return by how much the lane misses its condition, at most 0 when it is done.
GS_ALWAYS_INLINE double flow_lane(const Foam& law, double drag, int i, FoamReturn& local) {
  const FoamIteration found = foam_step(law, local.trial(i), drag, local.x[i]);
  local.x[i] = found.x;
  return found.miss - kFoamTolerance;
}

GS_ALWAYS_INLINE double lock_lane(const Foam& law, int i, FoamReturn& local) {
  const FoamIteration found = foam_lock_step(law, local.trial(i), local.room[i], local.x[i]);
  local.x[i] = found.x;
  return found.miss - kFoamTolerance;
}

GS_ALWAYS_INLINE bool solve_foam(const Foam& law, double drag, FoamReturn& local) {
  double worst = 1.0;
  for (int iteration = 0; iteration < kMaxFoamIterations && worst > 0.0; ++iteration) {
    worst = 0.0;
#pragma omp simd reduction(max : worst)
    for (int i = 0; i < kBatchTriangles; ++i) {
      const double miss = flow_lane(law, drag, i, local);
      worst = miss > worst ? miss : worst;
    }
  }
  if (worst > 0.0) return false;
  // Nothing to do in all but the one step in which a point locks.
  for (int iteration = 0; iteration < kMaxFoamIterations; ++iteration) {
    worst = 0.0;
#pragma omp simd reduction(max : worst)
    for (int i = 0; i < kBatchTriangles; ++i) {
      const double miss = lock_lane(law, i, local);
      worst = miss > worst ? miss : worst;
    }
    if (worst <= 0.0) return true;
  }
  return false;
}

/// Returns the work of the plastic strains, J.
GS_ALWAYS_INLINE double foam_lane(const Foam& law, const FoamReturn& local, const FullMemory& flow, double* state,
                                  int i) {
  const bool flows = local.overshoot[i] > 0.0;
  const double x = flows ? local.x[i] : 0.0;
  const Stress now = relaxed(law, stress_of(state, i), x);  // exactly the predictor without flow
  const Stress before = {flow.old_xx[i], flow.old_yy[i], flow.old_xy[i], flow.old_zz[i]};
  set_stress(state, i, now);
  const double strain = state[kFoamStrain * kBatchTriangles + i];
  const double square = contract(now, now);
  const double increment = x * std::sqrt(square);
  const double reached = strain + increment;
  // The last step of the plateau ends on it, whatever the round-off.
  const double locks = increment > (1.0 - 1e-9) * local.room[i] ? law.locked : reached;
  state[kFoamStrain * kBatchTriangles + i] = flows ? locks : strain;
  return flow.volume[i] * (0.5 * x * (contract(before, now) + square));
}

/// Work of the elastic strains, J: (old + new stress)/2 : elastic strain increment x volume at the middle of the step,
/// which is what the stored energy per volume grows by, times that volume. Together with the plastic work it is the
/// trapezoidal internal work. Stored energy by the present volume would miss what is in the volume that goes, the third
/// order of the strain.
GS_ALWAYS_INLINE double stored_lane(const Foam& law, const double* state, const FullMemory& flow, int i) {
  const Stress before = {flow.old_xx[i], flow.old_yy[i], flow.old_xy[i], flow.old_zz[i]};
  return flow.volume[i] * (law.elastic.stored_energy(stress_of(state, i)) - law.elastic.stored_energy(before));
}

/// Adds what the first `lanes` quads store in this step.
GS_ALWAYS_INLINE void add_stored(const Foam& law, const double* state, const FullMemory& flow, int lanes,
                                 RowOutcome& row) {
  alignas(kAlignment) double change[kBatchTriangles];
#pragma omp simd
  for (int i = 0; i < kBatchTriangles; ++i) change[i] = stored_lane(law, state, flow, i);
  for (int t = 0; t < kQuadTriangles; ++t) {
    for (int l = 0; l < lanes; ++l) row.stored += change[t * kBatchQuads + l];
  }
}

/// As for DH36, `drag` = eta/dt.
GS_ALWAYS_INLINE void flow_batch(const Foam& law, double* state, const FullMemory& flow, double drag, int lanes,
                                 double* work, RowOutcome& row) {
  alignas(kAlignment) FoamReturn local;
  double overshoot = 0.0;
#pragma omp simd reduction(max : overshoot)
  for (int i = 0; i < kBatchTriangles; ++i) {
    const double found = look_lane(law, state, i, local);
    overshoot = found > overshoot ? found : overshoot;
  }
  if (overshoot <= 0.0) return;
  ++row.yielding;
  row.unconverged += solve_foam(law, drag, local) ? 0 : 1;
  alignas(kAlignment) double done[kBatchTriangles];
#pragma omp simd
  for (int i = 0; i < kBatchTriangles; ++i) done[i] = foam_lane(law, local, flow, state, i);
  for (int t = 0; t < kQuadTriangles; ++t) {
    for (int l = 0; l < lanes; ++l) work[l] += done[t * kBatchQuads + l];
  }
}

GS_ALWAYS_INLINE void correct(const Foam& law, double* state, const FullMemory& flow, double drag, int lanes,
                              double* work, RowOutcome& row) {
  flow_batch(law, state, flow, drag, lanes, work, row);
  add_stored(law, state, flow, lanes, row);
}

}  // namespace grainstep::fe
