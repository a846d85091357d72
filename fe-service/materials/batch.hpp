/// @file What corrections of a batch of triangles have in common. All of it is inlined into every copy of the element
/// loop: a function that copies share is fused differently by the compiler, and another measure would change the last
/// bits of plane strain.
#pragma once

#include "fe-service/always_inline.hpp"
#include "fe-service/kernel/layout.hpp"
#include "fe-service/materials/law.hpp"
#include "fe-service/materials/tensor.hpp"

namespace grainstep::fe {

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

/// State of radial flow, after the stress. The last increment of plastic strain is where the next return begins.
enum RadialComponent : int { kPlasticStrain = kStressState, kStaticStrength, kLastIncrement, kRadialState };

/// Memory of a law whose flow is along the predictor's deviator.
struct RadialMemory {
  double volume[kBatchTriangles];    ///< m^3, at the middle of the step
  double old_work[kBatchTriangles];  ///< rotated old deviator : deviator of the predictor, Pa^2
};

GS_ALWAYS_INLINE void remember(RadialMemory& flow, int i, double volume, const Stress& old, const Stress& trial,
                               double) {
  flow.volume[i] = volume;
  flow.old_work[i] = contract(deviator(old), deviator(trial));
}

/// Memory of any other law.
struct FullMemory {
  double volume[kBatchTriangles];        ///< m^3, at the middle of the step
  double half_tangent[kBatchTriangles];  ///< tan of half the rotation during the step
  double old_xx[kBatchTriangles], old_yy[kBatchTriangles];
  double old_xy[kBatchTriangles], old_zz[kBatchTriangles];  ///< stress before the step, turned to its end, Pa
};

GS_ALWAYS_INLINE void remember(FullMemory& flow, int i, double volume, const Stress& old, const Stress&,
                               double half_tangent) {
  flow.volume[i] = volume;
  flow.half_tangent[i] = half_tangent;
  flow.old_xx[i] = old.xx;
  flow.old_yy[i] = old.yy;
  flow.old_xy[i] = old.xy;
  flow.old_zz[i] = old.zz;
}

}  // namespace grainstep::fe
