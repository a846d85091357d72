/// @file Compiled once per instruction set (GRAINSTEP_FE_ISA names the copy); see docs/decisions/0003-element-loop.md.
#include "fe-service/kernel/kernel.hpp"

#include "fe-service/kernel/sweep.hpp"

namespace grainstep::fe {

namespace {

template <class Law>
void sweep(RowSweep& row, const Law& law, const PlaneStrain& measure) {
  sweep_row(row, law, measure);
}

GS_ALWAYS_INLINE void stiffest_lane(const Batch& batch, const Elastic& law, int t, int next, int l, double* worst) {
  const double found = largest_stiffness(law, batch.arm(t, l), batch.arm(next, l));
  worst[l] = found > worst[l] ? found : worst[l];
}

double stiffest(const RowSweep& row, const Elastic& law) {
  double worst[kBatchQuads] = {};
  alignas(kAlignment) Batch batch;
  for (int first = 0; first < row.quads; first += kBatchQuads) {
    load(row, first, batch);
    for (int t = 0; t < kQuadTriangles; ++t) {
      const int next = (t + 1) % kQuadTriangles;
#pragma omp simd
      for (int l = 0; l < kBatchQuads; ++l) stiffest_lane(batch, law, t, next, l, worst);
    }
  }
  double result = 0.0;
  for (const double found : worst) result = found > result ? found : result;
  return result;
}

void kick(double* __restrict velocity, const double* __restrict force, const double* __restrict inverse_mass,
          double weight, std::size_t n) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) velocity[i] += weight * force[i] * inverse_mass[i];
}

void drift(double* __restrict position, const double* __restrict velocity, double step, std::size_t n) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) position[i] += step * velocity[i];
}

}  // namespace

#define GS_JOIN_(a, b) a##b
#define GS_JOIN(a, b) GS_JOIN_(a, b)
#define GS_TEXT_(a) #a
#define GS_TEXT(a) GS_TEXT_(a)

extern const Kernels GS_JOIN(kernels_, GRAINSTEP_FE_ISA);
const Kernels GS_JOIN(kernels_, GRAINSTEP_FE_ISA) = {
    GS_TEXT(GRAINSTEP_FE_ISA), &sweep<Elastic>, &sweep<Dh36>, &stiffest, &kick, &drift};

}  // namespace grainstep::fe
