/// @file The law on batches, compiled once per instruction set.
#include "dem-service/pair/law.hpp"

namespace grainstep::dem {
namespace {

template <int D, bool Friction, bool Energy, bool Mixed>
void evaluate(const PairLaw& law, double grown, PairBatch& batch, double* const* history, PairSums& sums) {
  constexpr int values = history_layout(D, Friction).values;
  const PairLaw constants = law;
  double* mine[most_history_values];
  for (int h = 0; h < values; ++h) mine[h] = history[h];
  PairSums sum = sums;
  for (int first = 0; first < batch.count; first += batch_lanes) {
#pragma omp simd
    for (int lane = 0; lane < batch_lanes; ++lane) {
      touch<D, Friction, Energy, Mixed>(constants, grown, batch, mine, first + lane, lane, sum);
    }
  }
  sums = sum;
}

}  // namespace

#define GS_JOIN_(a, b) a##b
#define GS_JOIN(a, b) GS_JOIN_(a, b)
#define GS_TEXT_(a) #a
#define GS_TEXT(a) GS_TEXT_(a)

#define GS_MASSES(D, FRICTION)                                                     \
  {                                                                                \
    {&evaluate<D, FRICTION, false, false>, &evaluate<D, FRICTION, false, true>}, { \
      &evaluate<D, FRICTION, true, false>, &evaluate<D, FRICTION, true, true>      \
    }                                                                              \
  }

extern const PairKernels GS_JOIN(pair_kernels_, GRAINSTEP_PAIR_ISA);
const PairKernels GS_JOIN(pair_kernels_, GRAINSTEP_PAIR_ISA) = {
    GS_TEXT(GRAINSTEP_PAIR_ISA),
    {{GS_MASSES(2, false), GS_MASSES(2, true)}, {GS_MASSES(3, false), GS_MASSES(3, true)}}};

}  // namespace grainstep::dem
