/// @file Eight distances at a time, for processors with AVX2. Only for files that are compiled once per instruction
/// set: nothing here may be shared with others. The bits are those of one distance at a time (sweeps.cpp).
#pragma once

#include <immintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "dem-service/native/rows.hpp"
#include "dem-service/pair/pair.hpp"

namespace grainstep::dem::native {
namespace {

/// For every set of lanes, their numbers in ascending order.
using LaneNumbers = std::array<std::array<std::uint8_t, 8>, 256>;

consteval LaneNumbers number_lanes() {
  LaneNumbers numbers{};
  for (std::size_t set = 0; set < numbers.size(); ++set) {
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < 8; ++lane) {
      if ((set >> lane & 1U) != 0) numbers[set][count++] = static_cast<std::uint8_t>(lane);
    }
  }
  return numbers;
}

constexpr LaneNumbers lane_numbers = number_lanes();

/// `values` with the lanes in `set` first; what the others hold is of no meaning.
[[gnu::always_inline]] inline __m256i gathered(__m256i values, int set) {
  const auto* numbers = reinterpret_cast<const __m128i*>(lane_numbers[static_cast<std::size_t>(set)].data());
  return _mm256_permutevar8x32_epi32(values, _mm256_cvtepu8_epi32(_mm_loadl_epi64(numbers)));
}

[[gnu::always_inline]] inline __m128 two_places(const float* a, const float* b) {
  const __m128 low = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(a)));
  return _mm_loadh_pi(low, reinterpret_cast<const __m64*>(b));
}

[[gnu::always_inline]] inline __m256 join(__m128 low, __m128 high) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1);
}

[[gnu::always_inline]] inline __m256 squared(__m256 v) { return _mm256_mul_ps(v, v); }

/// m^2, of eight pairs.
template <int D>
[[gnu::always_inline]] inline __m256 squared_distances(const float* places, const Pair* p) {
  const auto first = [&](int k) { return places + std::ptrdiff_t{p[k].first} * place_size<D>; };
  const auto second = [&](int k) { return places + std::ptrdiff_t{p[k].second} * place_size<D>; };
  if constexpr (D == 2) {
    // A horizontal sum takes two neighbours of the one, then two of the other, in each half.
    const auto apart = [&](int k) {
      const __m256 one = join(two_places(first(k), first(k + 1)), two_places(first(k + 4), first(k + 5)));
      const __m256 other = join(two_places(second(k), second(k + 1)), two_places(second(k + 4), second(k + 5)));
      return _mm256_sub_ps(one, other);
    };
    return _mm256_hadd_ps(squared(apart(0)), squared(apart(2)));
  } else {
    const auto apart = [&](int k) {
      const __m256 one = join(_mm_load_ps(first(k)), _mm_load_ps(first(k + 4)));
      return squared(_mm256_sub_ps(one, join(_mm_load_ps(second(k)), _mm_load_ps(second(k + 4)))));
    };
    return _mm256_hadd_ps(_mm256_hadd_ps(apart(0), apart(1)), _mm256_hadd_ps(apart(2), apart(3)));
  }
}

/// Radii of eight pairs, summed.
[[gnu::always_inline]] inline __m256 summed_radii(const float* radii, const Pair* p) {
  const auto* numbers = reinterpret_cast<const float*>(p);
  const __m256 a = _mm256_loadu_ps(numbers);
  const __m256 b = _mm256_loadu_ps(numbers + 8);
  // Firsts and seconds, each in the order 0 1 4 5 2 3 6 7; put right after the sum.
  const __m256i firsts = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88));
  const __m256i seconds = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xdd));
  const __m256 sum = _mm256_add_ps(_mm256_i32gather_ps(radii, firsts, 4), _mm256_i32gather_ps(radii, seconds, 4));
  return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(sum), 0xd8));
}

/// m^2, of one place from eight that follow each other.
template <int D>
[[gnu::always_inline]] inline __m256 squared_distances_from(const float* place, const float* others) {
  if constexpr (D == 2) {
    const __m256 from = _mm256_castpd_ps(_mm256_broadcast_sd(reinterpret_cast<const double*>(place)));
    const __m256 low = squared(_mm256_sub_ps(from, _mm256_loadu_ps(others)));
    const __m256 high = squared(_mm256_sub_ps(from, _mm256_loadu_ps(others + 8)));
    // 0 1 4 5 2 3 6 7
    const __m256 sums = _mm256_hadd_ps(low, high);
    return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(sums), 0xd8));
  } else {
    const __m256 from = _mm256_broadcast_ps(reinterpret_cast<const __m128*>(place));
    const auto apart = [&](std::ptrdiff_t k) {
      const __m256 two = join(_mm_load_ps(others + 4 * k), _mm_load_ps(others + 4 * k + 16));
      return squared(_mm256_sub_ps(from, two));
    };
    return _mm256_hadd_ps(_mm256_hadd_ps(apart(0), apart(1)), _mm256_hadd_ps(apart(2), apart(3)));
  }
}

[[gnu::always_inline]] inline int less(__m256 a, __m256 b) {
  return _mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
}

[[gnu::always_inline]] inline __m256i counted_from(std::ptrdiff_t first) {
  return _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
}

/// Writes eight pairs of `grain` with `others`.
[[gnu::always_inline]] inline void write_pairs(std::ptrdiff_t grain, __m256i others, Pair* found) {
  const __m256i one = _mm256_set1_epi32(static_cast<int>(grain));
  const __m256i low = _mm256_unpacklo_epi32(one, others);   // 0 1 4 5
  const __m256i high = _mm256_unpackhi_epi32(one, others);  // 2 3 6 7
  auto* to = reinterpret_cast<__m256i*>(found);
  _mm256_storeu_si256(to, _mm256_permute2x128_si256(low, high, 0x20));
  _mm256_storeu_si256(to + 1, _mm256_permute2x128_si256(low, high, 0x31));
}

}  // namespace
}  // namespace grainstep::dem::native
