/// @file Compiled once per instruction set (GRAINSTEP_FE_ISA names the copy); see docs/decisions/0003-element-loop.md.
#include "fe-service/kernel/kernel.hpp"

#include "fe-service/kernel/bulk_viscosity.hpp"
#include "fe-service/kernel/frequency.hpp"

namespace grainstep::fe {

namespace {

template <class Law, class Measure>
void sweep(RowSweep& row, const Law& law, const Measure& measure) {
  sweep_row(row, law, measure);
}

template <class... Law>
constexpr Sweeps<Law...> sweeps(LawList<Law...>) {
  return {Sweep<Law>{&sweep<Law, PlaneStrain>, &sweep<Law, Axisymmetric>}...};
}

void finish_upper(RowSweep& row) { finish_upper_row(row, row.first_row); }

template <class Measure>
void resist(RowSweep& row, const BulkViscosity& law, double* stress, const Measure& measure) {
  resist_row(row, law, stress, measure);
}

constexpr Resist kResist = {&resist<PlaneStrain>, &resist<Axisymmetric>};

template <class Measure>
double largest_frequency(const RowSweep& row, const Elastic& law, const QuadMass& mass, const Measure& measure,
                         double at_least) {
  return bound_row(row, law, mass, measure, at_least);
}

constexpr LargestFrequency kLargestFrequency = {&largest_frequency<PlaneStrain>, &largest_frequency<Axisymmetric>};

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
constinit const Kernels GS_JOIN(kernels_, GRAINSTEP_FE_ISA) = {
    GS_TEXT(GRAINSTEP_FE_ISA), sweeps(Laws{}), &finish_upper, kResist, kLargestFrequency, &kick, &drift};

}  // namespace grainstep::fe
