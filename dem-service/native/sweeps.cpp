/// @file The loops of sweeps.hpp, compiled once per instruction set: nothing here may be shared with other files, or
/// one of them could run another one's instructions.
#include "dem-service/native/sweeps.hpp"

#include "dem-service/native/rows.hpp"
#ifdef __AVX2__
#include "dem-service/native/eight.hpp"
#endif

namespace grainstep::dem::native {
namespace {

[[gnu::always_inline]] inline Quad larger(Quad a, Quad b) { return a > b ? a : b; }
[[gnu::always_inline]] inline Quad& quad_at(double* at) { return *reinterpret_cast<Quad*>(at); }

double move_discs(const Motion& m) {
  using R = Row<2>;
  const Quad frame{0.0, m.frame[0], m.frame[1], 0.0};
  const Quad drift{m.drift, m.drift, 0.0, 0.0};
  const double kick = m.kick;
  const double x0 = m.origin[0];
  const double y0 = m.origin[1];
  Quad fastest{};
  double* row = m.rows + m.first * R::size;
  double* force = m.forces + m.first * R::force_size;
  float* place = m.places + m.first * place_size<2>;
  for (std::ptrdiff_t i = m.first; i < m.last; ++i) {
    const double by_mass = kick * m.per_mass[i * m.each];
    const Quad by{kick * m.per_inertia[i * m.each], by_mass, by_mass, 0.0};
    const Quad velocity = quad_at(row + 4) + quad_at(force) * by;
    quad_at(row + 4) = velocity;
    const Quad position = quad_at(row) + __builtin_shufflevector(velocity, velocity, 1, 2, 3, 3) * drift;
    quad_at(row) = position;
    quad_at(force) = Quad{};
    const Quad speed = velocity - frame;
    fastest = larger(speed * speed, fastest);
    place[0] = static_cast<float>(position[0] - x0);
    place[1] = static_cast<float>(position[1] - y0);
    row += R::size;
    force += R::force_size;
    place += place_size<2>;
  }
  return fastest[1] + fastest[2];
}

double move_spheres(const Motion& m) {
  using R = Row<3>;
  const Quad frame{m.frame[0], m.frame[1], m.frame[2], 0.0};
  const Quad origin{m.origin[0], m.origin[1], m.origin[2], 0.0};
  Quad fastest{};
  double* row = m.rows + m.first * R::size;
  double* force = m.forces + m.first * R::force_size;
  float* place = m.places + m.first * place_size<3>;
  for (std::ptrdiff_t i = m.first; i < m.last; ++i) {
    const Quad velocity = quad_at(row + R::velocity) + quad_at(force) * (m.kick * m.per_mass[i * m.each]);
    quad_at(row + R::velocity) = velocity;
    quad_at(row + R::spin) += quad_at(force + R::torque) * (m.kick * m.per_inertia[i * m.each]);
    const Quad position = quad_at(row) + velocity * m.drift;
    quad_at(row) = position;
    quad_at(force) = Quad{};
    quad_at(force + R::torque) = Quad{};
    const Quad speed = velocity - frame;
    fastest = larger(speed * speed, fastest);
    const Quad from = position - origin;
    for (int c = 0; c < 4; ++c) place[c] = static_cast<float>(from[c]);
    row += R::size;
    force += R::force_size;
    place += place_size<3>;
  }
  return fastest[0] + fastest[1] + fastest[2];
}

#ifdef __AVX2__

/// The first `count` of eight lanes.
[[gnu::always_inline]] inline int lanes_below(std::ptrdiff_t count) {
  return count >= static_cast<std::ptrdiff_t>(lanes_at_once) ? 0xff : (1 << count) - 1;
}

template <int D, bool Own, bool Numbered>
[[gnu::always_inline]] inline std::ptrdiff_t filter(const PairSearch& search, std::uint32_t* found) {
  std::ptrdiff_t count = 0;
  const __m256 slack = _mm256_set1_ps(search.slack);
  __m256 within = squared(_mm256_set1_ps(search.reach + search.slack));
  for (std::ptrdiff_t k = search.first; k < search.last; k += lanes_at_once) {
    const Pair* pairs = search.pairs + k;
    if constexpr (Own) within = squared(_mm256_add_ps(summed_radii(search.radii, pairs), slack));
    const int near = less(squared_distances<D>(search.places, pairs), within) & lanes_below(search.last - k);
    const __m256i numbers =
        Numbered ? _mm256_loadu_si256(reinterpret_cast<const __m256i*>(search.numbers + k)) : counted_from(k);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(found + count), gathered(numbers, near));
    count += __builtin_popcount(static_cast<unsigned>(near));
  }
  return count;
}

template <int D>
std::ptrdiff_t near(const Candidates& c, Pair* found) {
  std::ptrdiff_t count = 0;
  const float* place = c.places + c.grain * place_size<D>;
  const __m256 reach = _mm256_set1_ps(c.reach[c.grain]);
  for (int r = 0; r < c.count; ++r) {
    const Range range = c.ranges[r];
    for (std::ptrdiff_t j = range.first; j < range.last; j += lanes_at_once) {
      const __m256 within = squared(_mm256_add_ps(reach, _mm256_loadu_ps(c.reach + j)));
      const __m256 apart = squared_distances_from<D>(place, c.places + j * place_size<D>);
      const int set = less(apart, within) & lanes_below(range.last - j);
      write_pairs(c.grain, gathered(counted_from(j), set), found + count);
      count += __builtin_popcount(static_cast<unsigned>(set));
    }
  }
  return count;
}

#else

template <int D>
[[gnu::always_inline]] inline float squared_distance(const float* a, const float* b) {
  const float dx = a[0] - b[0];
  const float dy = a[1] - b[1];
  float sum = dx * dx + dy * dy;
  if constexpr (D == 3) {
    const float dz = a[2] - b[2];
    sum += dz * dz;
  }
  return sum;
}

/// Without a branch: whether a pair is near cannot be foretold.
template <int D, bool Own, bool Numbered>
[[gnu::always_inline]] inline std::ptrdiff_t filter(const PairSearch& search, std::uint32_t* found) {
  const float* places = search.places;
  std::ptrdiff_t count = 0;
  float within = (search.reach + search.slack) * (search.reach + search.slack);
  for (std::ptrdiff_t k = search.first; k < search.last; ++k) {
    const std::ptrdiff_t i = search.pairs[k].first;
    const std::ptrdiff_t j = search.pairs[k].second;
    const float squared = squared_distance<D>(places + i * place_size<D>, places + j * place_size<D>);
    if constexpr (Own) {
      const float own = search.radii[i] + search.radii[j] + search.slack;
      within = own * own;
    }
    found[count] = Numbered ? search.numbers[k] : static_cast<std::uint32_t>(k);
    count += squared < within ? 1 : 0;
  }
  return count;
}

template <int D>
std::ptrdiff_t near(const Candidates& c, Pair* found) {
  std::ptrdiff_t count = 0;
  const float* place = c.places + c.grain * place_size<D>;
  const float reach = c.reach[c.grain];
  for (int r = 0; r < c.count; ++r) {
    for (std::ptrdiff_t j = c.ranges[r].first; j < c.ranges[r].last; ++j) {
      const float both = reach + c.reach[j];
      found[count] = {static_cast<std::int32_t>(c.grain), static_cast<std::int32_t>(j)};
      count += squared_distance<D>(place, c.places + j * place_size<D>) < both * both ? 1 : 0;
    }
  }
  return count;
}

#endif

template <int D>
std::ptrdiff_t touching(const PairSearch& search, std::uint32_t* found) {
  if (search.radii != nullptr) {
    return search.numbers != nullptr ? filter<D, true, true>(search, found) : filter<D, true, false>(search, found);
  }
  return search.numbers != nullptr ? filter<D, false, true>(search, found) : filter<D, false, false>(search, found);
}

template <int D>
float displaced(const Displacement& d) {
  float most = 0.0F;
  for (std::ptrdiff_t i = d.first; i < d.last; ++i) {
    const float* now = d.places + i * place_size<D>;
    const float* before = d.before + i * place_size<D>;
    float sum = 0.0F;
    for (int c = 0; c < D; ++c) {
      const float by = now[c] - before[c] - d.shift[c];
      sum += by * by;
    }
    most = sum > most ? sum : most;
  }
  return most;
}

}  // namespace

#define GS_JOIN_(a, b) a##b
#define GS_JOIN(a, b) GS_JOIN_(a, b)
#define GS_TEXT_(a) #a
#define GS_TEXT(a) GS_TEXT_(a)

extern const Sweeps GS_JOIN(sweeps_, GRAINSTEP_NATIVE_ISA);
const Sweeps GS_JOIN(sweeps_, GRAINSTEP_NATIVE_ISA) = {GS_TEXT(GRAINSTEP_NATIVE_ISA),
                                                       {&move_discs, &move_spheres},
                                                       {&touching<2>, &touching<3>},
                                                       {&displaced<2>, &displaced<3>},
                                                       {&near<2>, &near<3>}};

}  // namespace grainstep::dem::native
