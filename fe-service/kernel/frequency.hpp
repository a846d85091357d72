/// @file Upper bound of the highest frequency of quads, from which the stable step follows.
///
/// With lumped masses the largest omega^2 of an assembled body is at most the largest one of its parts, each with its
/// own share of the mass (Rayleigh's quotient of a sum is a weighted mean of the parts' quotients). The part taken here
/// is the quad of four crossed triangles, which share their centre node: its bound lies well below the single
/// triangle's.
///
/// omega^2 is a bound for a quad exactly if omega^2 M - K has no negative eigenvalue. Per unit of thickness, with w_i
/// the displacements of the corners relative to the centre, masses m/6 at the corners and m/3 at the centre, and the
/// best displacement of the centre put in, that matrix is
///     omega^2 m/6 [sum |w_i|^2 - |sum w_i|^2/6] - w . K_c w
/// with 8 degrees of freedom. Its elimination without pivoting shows the sign: all pivots positive means safe.
#pragma once

#include "fe-service/kernel/batch.hpp"

namespace grainstep::fe {
namespace {

/// omega^2 M - K of eight quads, its lower half; degree of freedom 2 x corner + component.
struct QuadMatrices {
  double at[8][8][kBatchQuads];
};

/// Subtracts the block of triangle T between two of its outer nodes, whose shape functions' gradients are gi/T, gj/T
/// with T twice the area: K_ij = T/2 [lambda gi (x) gj + mu gj (x) gi + mu gi . gj I]/T^2.
GS_ALWAYS_INLINE void subtract_block(const Elastic& law, Vec2 gi, Vec2 gj, double scale, int i, int j, int l,
                                     QuadMatrices& m) {
  const double same = law.mu * dot(gi, gj);
  m.at[2 * i][2 * j][l] -= scale * ((law.lambda + law.mu) * gi.x * gj.x + same);
  m.at[2 * i + 1][2 * j + 1][l] -= scale * ((law.lambda + law.mu) * gi.y * gj.y + same);
  m.at[2 * i + 1][2 * j][l] -= scale * (law.lambda * gi.y * gj.x + law.mu * gi.x * gj.y);
  if (i != j) m.at[2 * i][2 * j + 1][l] -= scale * (law.lambda * gi.x * gj.y + law.mu * gi.y * gj.x);
}

template <int T>
GS_ALWAYS_INLINE void subtract_triangle(const Batch& batch, const Elastic& law, int l, QuadMatrices& m) {
  constexpr int next = (T + 1) % kQuadTriangles;
  const Vec2 a = batch.arm(T, l);
  const Vec2 b = batch.arm(next, l);
  const Vec2 at_a = {b.y, -b.x};
  const Vec2 at_b = {-a.y, a.x};
  const double scale = 0.5 / cross(a, b);
  subtract_block(law, at_a, at_a, scale, T, T, l, m);
  subtract_block(law, at_b, at_b, scale, next, next, l, m);
  if constexpr (next > T) {
    subtract_block(law, at_b, at_a, scale, next, T, l, m);
  } else {
    subtract_block(law, at_a, at_b, scale, T, next, l, m);
  }
}

/// `mass`: of a quad, for a unit thickness, kg/m.
GS_ALWAYS_INLINE void fill(const Batch& batch, const Elastic& law, double mass, double omega_squared, QuadMatrices& m) {
  const double share = omega_squared * mass / 6.0;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double value = (i == j ? share : 0.0) - ((i - j) % 2 == 0 ? share / 6.0 : 0.0);
#pragma omp simd
      for (int l = 0; l < kBatchQuads; ++l) m.at[i][j][l] = value;
    }
  }
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) subtract_triangle<0>(batch, law, l, m);
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) subtract_triangle<1>(batch, law, l, m);
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) subtract_triangle<2>(batch, law, l, m);
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) subtract_triangle<3>(batch, law, l, m);
}

GS_ALWAYS_INLINE void eliminate(int k, QuadMatrices& m) {
  for (int i = k + 1; i < 8; ++i) {
    double factor[kBatchQuads];
#pragma omp simd
    for (int l = 0; l < kBatchQuads; ++l) factor[l] = m.at[i][k][l] / m.at[k][k][l];
    for (int j = k + 1; j <= i; ++j) {
#pragma omp simd
      for (int l = 0; l < kBatchQuads; ++l) m.at[i][j][l] -= factor[l] * m.at[j][k][l];
    }
  }
}

/// Whether omega^2 bounds all quads of the batch.
inline bool bounds_batch(const Batch& batch, const Elastic& law, double mass, double omega_squared) {
  alignas(kAlignment) QuadMatrices m;
  fill(batch, law, mass, omega_squared, m);
  for (int k = 0; k < 8; ++k) {
    double pivot = m.at[k][k][0];
    for (int l = 1; l < kBatchQuads; ++l) pivot = m.at[k][k][l] < pivot ? m.at[k][k][l] : pivot;
    if (!(pivot > 0.0)) return false;
    eliminate(k, m);
  }
  return true;
}

/// Bound by the stiffest single triangle with its own mass.
inline double triangle_bound(const Batch& batch, const Elastic& law, double mass) {
  double worst = 0.0;
  for (int t = 0; t < kQuadTriangles; ++t) {
    for (int l = 0; l < kBatchQuads; ++l) {
      const double found = largest_stiffness(law, batch.arm(t, l), batch.arm((t + 1) % kQuadTriangles, l));
      worst = found > worst ? found : worst;
    }
  }
  return 3.0 * worst / (0.25 * mass);
}

/// The smallest of `at_least` and the values above it that bounds all quads of a row, within kFrequencyTolerance.
inline double bound_row(const RowSweep& row, const Elastic& law, double mass, double at_least) {
  double bound = at_least;
  alignas(kAlignment) Batch batch;
  for (int first = 0; first < row.quads; first += kBatchQuads) {
    load(row, first, batch);
    if (bounds_batch(batch, law, mass, bound)) continue;
    double too_low = bound;
    bound = triangle_bound(batch, law, mass);
    // As many halvings as can matter, so that nothing that is no number can keep this going (-ffast-math).
    for (int i = 0; i < 60 && bound - too_low > kFrequencyTolerance * bound; ++i) {
      const double middle = 0.5 * (too_low + bound);
      (bounds_batch(batch, law, mass, middle) ? bound : too_low) = middle;
    }
  }
  return bound;
}

}  // namespace
}  // namespace grainstep::fe
