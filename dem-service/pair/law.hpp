/// @file The contact law between two particles, (2.1) and (2.2), on one lane of a batch.
///
/// Operations come in the order in which LAMMPS's gran/hooke/history does them, so that every bit is the same; what is
/// zero in the plane is left out. docs/decisions/0009-own-pair-style.md.
#pragma once

#include <cmath>

#include "dem-service/pair/batch.hpp"

#define GS_PAIR_INLINE [[gnu::always_inline]] static inline

namespace grainstep::dem {

template <int D>
GS_PAIR_INLINE double product(const double* a, const double* b) {
  double sum = a[0] * b[0] + a[1] * b[1];
  if constexpr (D == 3) sum += a[2] * b[2];
  return sum;
}

/// a x b: in the plane its one component.
template <int D>
GS_PAIR_INLINE void turning(const double* a, const double* b, double* moment) {
  if constexpr (D == 3) {
    moment[0] = a[1] * b[2] - a[2] * b[1];
    moment[1] = a[2] * b[0] - a[0] * b[2];
    moment[2] = a[0] * b[1] - a[1] * b[0];
  } else {
    moment[0] = a[0] * b[1] - a[1] * b[0];
  }
}

/// The velocity of one skin on the other: `rate` without its normal part, less what the spins add.
template <int D>
GS_PAIR_INLINE void slip(const double* branch, const double* spin, double* rate) {
  if constexpr (D == 3) {
    rate[0] -= branch[2] * spin[1] - branch[1] * spin[2];
    rate[1] -= branch[0] * spin[2] - branch[2] * spin[0];
    rate[2] -= branch[1] * spin[0] - branch[0] * spin[1];
  } else {
    rate[0] += branch[1] * spin[0];
    rate[1] -= branch[0] * spin[0];
  }
}

/// Spring, slider and torque. `normal`: the normal force, N. `drag`: N, on the first particle.
template <int D>
GS_PAIR_INLINE void rub(const PairLaw& law, double grown, const double* branch, double per_length, double per_squared,
                        double normal, const double* rate, double* spring, double* drag, double* torque) {
  for (int c = 0; c < D; ++c) spring[c] += rate[c] * grown;
  // The spring turns with the pair: what points along the branch now is dropped. Nothing turns at the start.
  const double along = grown > 0.0 ? product<D>(spring, branch) * per_squared : 0.0;
  for (int c = 0; c < D; ++c) spring[c] -= along * branch[c];
  for (int c = 0; c < D; ++c) drag[c] = -(law.tangential_stiffness * spring[c]);
  const double size = std::sqrt(product<D>(drag, drag));
  const double limit = law.friction * std::fabs(normal);
  const double share = size > limit ? limit / size : 1.0;
  for (int c = 0; c < D; ++c) {
    spring[c] *= share;
    drag[c] *= share;
  }
  turning<D>(branch, drag, torque);
  for (int c = 0; c < (D == 3 ? 3 : 1); ++c) torque[c] = per_length * torque[c];
}

/// Work in the interval that ends now: half of it by the old forces, half by the new ones, both with the interval's
/// velocity. The old branch is the new one less the way between.
template <int D, bool Friction>
GS_PAIR_INLINE void book(const PairLaw& law, double grown, const double* before, const double* after,
                         const double* velocity, double approach, const double* rolling, int lane, PairSums& sums) {
  const double half = 0.5 * grown;
  const double approach_before = approach - grown * product<D>(velocity, velocity);
  sums.damping[lane] += half * (after[0] * approach + before[0] * approach_before);
  if constexpr (Friction) {
    constexpr HistoryLayout at = history_layout(D, true);
    double both[3];
    double torques[3];
    for (int c = 0; c < D; ++c) both[c] = law.tangential_stiffness * (before[at.spring + c] + after[at.spring + c]);
    double work = product<D>(both, velocity);
    for (int c = 0; c < (D == 3 ? 3 : 1); ++c) {
      torques[c] = before[at.torque + c] + after[at.torque + c];
      work += torques[c] * rolling[c];
    }
    sums.tangential[lane] += half * work;
    sums.stored_tangential[lane] += 0.5 * law.tangential_stiffness * product<D>(after + at.spring, after + at.spring);
  }
}

/// One pair: its force into the batch, its history brought up to date.
template <int D, bool Friction, bool Energy, bool Mixed>
GS_PAIR_INLINE void touch(const PairLaw& law, double grown, PairBatch& batch, double* const* history, int l, int lane,
                          PairSums& sums) {
  constexpr HistoryLayout at = history_layout(D, Friction);
  constexpr int turns = D == 3 ? 3 : 1;
  double branch[3];
  double velocity[3];
  double rolling[3];
  double before[most_history_values];
  double after[most_history_values];
  for (int c = 0; c < D; ++c) branch[c] = batch.branch[c][l];
  for (int c = 0; c < D; ++c) velocity[c] = batch.velocity[c][l];
  for (int c = 0; c < turns; ++c) rolling[c] = batch.rolling[c][l];
  for (int h = 0; h < at.values; ++h) before[h] = history[h][l];

  const double squared = product<D>(branch, branch);
  const double length = std::sqrt(squared);
  const double per_length = 1.0 / length;
  const double per_squared = 1.0 / squared;
  const double overlap = batch.reach[l] - length;
  const double approach = product<D>(velocity, branch);
  const double effective_mass = batch.effective_mass[l];
  double damping_rate = law.damping_rate;
  if constexpr (Mixed) damping_rate = contact::damping_rate(*law.damping_table, effective_mass);
  after[0] = effective_mass * damping_rate * approach * per_squared;
  const double push = law.normal_stiffness * overlap * per_length - after[0];

  double force[3];
  for (int c = 0; c < D; ++c) force[c] = branch[c] * push;
  if constexpr (Friction) {
    double rate[3];
    double spin[3];
    double drag[3];
    for (int c = 0; c < D; ++c) rate[c] = velocity[c] - branch[c] * approach * per_squared;
    for (int c = 0; c < turns; ++c) spin[c] = rolling[c] * per_length;
    slip<D>(branch, spin, rate);
    for (int c = 0; c < D; ++c) after[at.spring + c] = before[at.spring + c];
    rub<D>(law, grown, branch, per_length, per_squared, push * length, rate, after + at.spring, drag,
           after + at.torque);
    for (int c = 0; c < D; ++c) force[c] += drag[c];
  }
  for (int c = 0; c < D; ++c) batch.force[c][l] = force[c];
  for (int h = 0; h < at.values; ++h) history[h][l] = after[h];
  if constexpr (Energy) {
    book<D, Friction>(law, grown, before, after, velocity, approach, rolling, lane, sums);
    sums.stored_normal[lane] += 0.5 * law.normal_stiffness * overlap * overlap;
    const double share = overlap / batch.reach[l];
    sums.largest_overlap[lane] = share > sums.largest_overlap[lane] ? share : sums.largest_overlap[lane];
  }
}

}  // namespace grainstep::dem
