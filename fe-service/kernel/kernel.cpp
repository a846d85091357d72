/// @file Compiled once per instruction set (GRAINSTEP_FE_ISA names the copy); see docs/decisions/0003-element-loop.md.
#include "fe-service/kernel/kernel.hpp"

#include "fe-service/kernel/frequency.hpp"
#include "fe-service/kernel/sweep.hpp"

namespace grainstep::fe {

namespace {

template <class Law>
void sweep(RowSweep& row, const Law& law, const PlaneStrain& measure) {
  sweep_row(row, law, measure);
}

double largest_frequency(const RowSweep& row, const Elastic& law, double quad_mass, double at_least) {
  return bound_row(row, law, quad_mass, at_least);
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
    GS_TEXT(GRAINSTEP_FE_ISA), &sweep<Elastic>, &sweep<Dh36>, &sweep<Core>, &sweep<Foam>,
    &largest_frequency,        &kick,           &drift};

}  // namespace grainstep::fe
