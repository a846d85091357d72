/// @file Upper bound of the highest frequency of quads, from which the stable step follows.
///
/// With lumped masses the largest omega^2 of an assembled body is at most the largest one of its parts, each with its
/// own share of the mass (Rayleigh's quotient of a sum is a weighted mean of the parts' quotients). The part taken here
/// is the quad of four crossed triangles, which share their centre node: its bound lies well below the single
/// triangle's.
///
/// omega^2 is a bound for a quad exactly if omega^2 M - K has no negative eigenvalue. Its elimination without pivoting
/// shows the sign: all pivots positive means safe.
///
/// Plane strain, per unit of thickness: with w_i the displacements of the corners relative to the centre, masses m/6 at
/// the corners and m/3 at the centre, and the best displacement of the centre put in, the matrix is
///     omega^2 m/6 [sum |w_i|^2 - |sum w_i|^2/6] - w . K_c w
/// with 8 degrees of freedom.
///
/// Solid of revolution, over 2 pi: a displacement u of the whole stretches the hoops, so there is no such reduction,
/// and masses grow with the radius. The 10 displacements of the five nodes are taken as they are. With the strains
/// (grad, hoop = (u_a + u_b + u_c)/(3 r_c)) a triangle adds r_c A (lambda (tr e)^2 + 2 mu e : e). A node at r = 0
/// cannot move along r; leaving that degree of freedom out is what it does to the assembled body as well, where a
/// constraint only lowers the largest frequency.
#pragma once

#include "fe-service/kernel/batch.hpp"

namespace grainstep::fe {
namespace {

/// omega^2 M - K of eight quads, its lower half; degree of freedom 2 x node + component, corners before the centre.
template <int N>
struct QuadMatrices {
  double at[N][N][kBatchQuads];
};

/// Degrees of freedom of a quad.
constexpr int degrees(const PlaneStrain&) { return 8; }
constexpr int degrees(const Axisymmetric&) { return 10; }

/// Subtracts the block of triangle T between two of its nodes, whose shape functions' gradients are gi/T, gj/T
/// with T twice the area: K_ij = T/2 [lambda gi (x) gj + mu gj (x) gi + mu gi . gj I]/T^2.
template <int N>
GS_ALWAYS_INLINE void subtract_block(const Elastic& law, Vec2 gi, Vec2 gj, double scale, int i, int j, int l,
                                     QuadMatrices<N>& m) {
  const double same = law.mu * dot(gi, gj);
  m.at[2 * i][2 * j][l] -= scale * ((law.lambda + law.mu) * gi.x * gj.x + same);
  m.at[2 * i + 1][2 * j + 1][l] -= scale * ((law.lambda + law.mu) * gi.y * gj.y + same);
  m.at[2 * i + 1][2 * j][l] -= scale * (law.lambda * gi.y * gj.x + law.mu * gi.x * gj.y);
  if (i != j) m.at[2 * i][2 * j + 1][l] -= scale * (law.lambda * gi.x * gj.y + law.mu * gi.y * gj.x);
}

template <int T>
GS_ALWAYS_INLINE void subtract_triangle(const PlaneStrain&, const Batch& batch, const Elastic& law, int l,
                                        QuadMatrices<8>& m) {
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

/// A node of a ring triangle.
struct RingNode {
  Vec2 g;       ///< gradient of its shape function x twice the area, m
  double free;  ///< 0 at r = 0, where it cannot move along r; else 1
  int number;
};

/// Twice the area of a triangle and the radius of its centroid.
struct RingTriangle {
  double twice_area, radius;
};

/// As subtract_block, with the hoop strain; over 2 pi.
GS_ALWAYS_INLINE void subtract_ring_block(const Elastic& law, const RingNode& a, const RingNode& b,
                                          const RingTriangle& t, int l, QuadMatrices<10>& m) {
  const std::ptrdiff_t i = a.number;
  const std::ptrdiff_t j = b.number;
  const double scale = 0.5 * t.radius / t.twice_area;
  const double same = law.mu * dot(a.g, b.g);
  const double sixth = law.lambda * (1.0 / 6.0);
  const double hoop = sixth * (a.g.x + b.g.x) + law.longitudinal_modulus() * t.twice_area / (18.0 * t.radius);
  m.at[2 * i][2 * j][l] -= a.free * b.free * (scale * ((law.lambda + law.mu) * a.g.x * b.g.x + same) + hoop);
  m.at[2 * i + 1][2 * j + 1][l] -= scale * ((law.lambda + law.mu) * a.g.y * b.g.y + same);
  m.at[2 * i + 1][2 * j][l] -= b.free * (scale * (law.lambda * a.g.y * b.g.x + law.mu * a.g.x * b.g.y) + sixth * a.g.y);
  if (i == j) return;
  m.at[2 * i][2 * j + 1][l] -= a.free * (scale * (law.lambda * a.g.x * b.g.y + law.mu * a.g.y * b.g.x) + sixth * b.g.y);
}

template <int T>
GS_ALWAYS_INLINE void subtract_triangle(const Axisymmetric&, const Batch& batch, const Elastic& law, int l,
                                        QuadMatrices<10>& m) {
  constexpr int next = (T + 1) % kQuadTriangles;
  constexpr int first = next > T ? T : next;  // the smaller number, so that the lower half is filled
  constexpr int second = next > T ? next : T;
  const Vec2 a = batch.arm(T, l);
  const Vec2 b = batch.arm(next, l);
  const double centre = batch.centre_x[l];
  const Vec2 at_a = {b.y, -b.x};
  const Vec2 at_b = {-a.y, a.x};
  const double r_a = centre + a.x;
  const double r_b = centre + b.x;
  const RingNode of_a = {at_a, r_a > 0.0 ? 1.0 : 0.0, T};
  const RingNode of_b = {at_b, r_b > 0.0 ? 1.0 : 0.0, next};
  const RingNode middle = {{-at_a.x - at_b.x, -at_a.y - at_b.y}, 1.0, 4};
  const RingNode& low = first == T ? of_a : of_b;
  const RingNode& high = second == T ? of_a : of_b;
  const RingTriangle t = {cross(a, b), (centre + r_a + r_b) * (1.0 / 3.0)};
  subtract_ring_block(law, low, low, t, l, m);
  subtract_ring_block(law, high, high, t, l, m);
  subtract_ring_block(law, middle, middle, t, l, m);
  subtract_ring_block(law, high, low, t, l, m);
  subtract_ring_block(law, middle, low, t, l, m);
  subtract_ring_block(law, middle, high, t, l, m);
}

GS_ALWAYS_INLINE void fill_mass(const PlaneStrain&, const QuadMass& mass, int /*first*/, double omega_squared,
                                QuadMatrices<8>& m) {
  const double share = omega_squared * mass.areal / 6.0;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double value = (i == j ? share : 0.0) - ((i - j) % 2 == 0 ? share / 6.0 : 0.0);
#pragma omp simd
      for (int l = 0; l < kBatchQuads; ++l) m.at[i][j][l] = value;
    }
  }
}

/// Lanes beyond the end of the row, which repeat the last quad, get the mass of a quad further out: more than it has.
GS_ALWAYS_INLINE void fill_mass(const Axisymmetric&, const QuadMass& mass, int first, double omega_squared,
                                QuadMatrices<10>& m) {
  const double share = omega_squared * mass.areal / 6.0;
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < i; ++j) {
      for (int l = 0; l < kBatchQuads; ++l) m.at[i][j][l] = 0.0;
    }
    // Corners 0 and 3 are the inner ones: (r_centre + r_corner)/2, and twice the whole for the centre.
    const int node = i / 2;
    const double offset = node == 4 ? 0.0 : (node == 0 || node == 3 ? -0.25 : 0.25) * mass.width;
    const double times = node == 4 ? 2.0 : 1.0;
    for (int l = 0; l < kBatchQuads; ++l) {
      const double centre = mass.left + (first + l + 0.5) * mass.width;
      m.at[i][i][l] = times * share * (centre + offset);
    }
  }
}

template <class Measure, int N>
GS_ALWAYS_INLINE void fill(const Measure& measure, const Batch& batch, const Elastic& law, const QuadMass& mass,
                           int first, double omega_squared, QuadMatrices<N>& m) {
  fill_mass(measure, mass, first, omega_squared, m);
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) subtract_triangle<0>(measure, batch, law, l, m);
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) subtract_triangle<1>(measure, batch, law, l, m);
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) subtract_triangle<2>(measure, batch, law, l, m);
#pragma omp simd
  for (int l = 0; l < kBatchQuads; ++l) subtract_triangle<3>(measure, batch, law, l, m);
}

template <int N>
GS_ALWAYS_INLINE void eliminate(int k, QuadMatrices<N>& m) {
  for (int i = k + 1; i < N; ++i) {
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
template <class Measure>
bool bounds_batch(const Measure& measure, const Batch& batch, const Elastic& law, const QuadMass& mass, int first,
                  double omega_squared) {
  constexpr int size = degrees(Measure{});
  alignas(kAlignment) QuadMatrices<size> m;
  fill(measure, batch, law, mass, first, omega_squared, m);
  for (int k = 0; k < size; ++k) {
    double pivot = m.at[k][k][0];
    for (int l = 1; l < kBatchQuads; ++l) pivot = m.at[k][k][l] < pivot ? m.at[k][k][l] : pivot;
    if (!(pivot > 0.0)) return false;
    eliminate(k, m);
  }
  return true;
}

/// Bound by the stiffest single triangle with its own mass.
inline double simple_bound(const PlaneStrain&, const Batch& batch, const Elastic& law, const QuadMass& mass,
                           int /*first*/) {
  double worst = 0.0;
  for (int t = 0; t < kQuadTriangles; ++t) {
    for (int l = 0; l < kBatchQuads; ++l) {
      const double found = largest_stiffness(law, batch.arm(t, l), batch.arm((t + 1) % kQuadTriangles, l));
      worst = found > worst ? found : worst;
    }
  }
  return 3.0 * worst / (0.25 * mass.areal);
}

/// Bound by the trace: the largest eigenvalue of M^-1 K, whose eigenvalues are not negative, is at most their sum.
inline double simple_bound(const Axisymmetric& measure, const Batch& batch, const Elastic& law, const QuadMass& mass,
                           int first) {
  alignas(kAlignment) QuadMatrices<10> stiffness;
  alignas(kAlignment) QuadMatrices<10> masses;
  fill(measure, batch, law, mass, first, 0.0, stiffness);
  fill_mass(measure, mass, first, 1.0, masses);
  double worst = 0.0;
  for (int l = 0; l < kBatchQuads; ++l) {
    double sum = 0.0;
    for (int i = 0; i < 10; ++i) sum -= stiffness.at[i][i][l] / masses.at[i][i][l];
    worst = sum > worst ? sum : worst;
  }
  return worst * (1.0 + 1e-9);  // above the sum by more than its round-off
}

/// The smallest of `at_least` and the values above it that bounds all quads of a row, within kFrequencyTolerance.
template <class Measure>
double bound_row(const RowSweep& row, const Elastic& law, const QuadMass& mass, const Measure& measure,
                 double at_least) {
  double bound = at_least;
  alignas(kAlignment) Batch batch;
  for (int first = 0; first < row.quads; first += kBatchQuads) {
    load(row, first, batch);
    if (bounds_batch(measure, batch, law, mass, first, bound)) continue;
    double too_low = bound;
    bound = simple_bound(measure, batch, law, mass, first);
    // As many halvings as can matter, so that nothing that is no number can keep this going (-ffast-math).
    for (int i = 0; i < 60 && bound - too_low > kFrequencyTolerance * bound; ++i) {
      const double middle = 0.5 * (too_low + bound);
      (bounds_batch(measure, batch, law, mass, first, middle) ? bound : too_low) = middle;
    }
  }
  return bound;
}

}  // namespace
}  // namespace grainstep::fe
