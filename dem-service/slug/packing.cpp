#include "dem-service/slug/packing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>
#include <utility>

#include "base/error.hpp"

namespace grainstep::dem {
namespace {

using surface::Vec;
using surface::Vec2;
using surface::Vec3;

/// Cells as wide as the largest particle, so that whoever overlaps lies in a neighbouring one.
template <std::size_t N>
class Cells {
 public:
  /// Centres lie between `low` and `high`.
  Cells(const Vec<N>& low, const Vec<N>& high, std::span<const double> diameters)
      : low_(low), size_(diameters.front()), diameters_(diameters), next_(diameters.size(), vacant) {
    std::int64_t cells = 1;
    for (std::size_t axis = 0; axis < N; ++axis) {
      count_[axis] = static_cast<std::int64_t>((high[axis] - low[axis]) / size_) + 1;
      cells *= count_[axis];
    }
    first_.assign(static_cast<std::size_t>(cells), vacant);
  }

  /// The next particle takes the place if it overlaps no other one.
  bool take(const Vec<N>& p, std::vector<Vec<N>>& centres) {
    const double diameter = diameters_[centres.size()];
    Numbers own;
    Numbers from;
    Numbers to;
    for (std::size_t axis = 0; axis < N; ++axis) {
      own[axis] = std::min(static_cast<std::int64_t>((p[axis] - low_[axis]) / size_), count_[axis] - 1);
      from[axis] = std::max<std::int64_t>(0, own[axis] - 1);
      to[axis] = std::min(own[axis] + 1, count_[axis] - 1);
    }
    Numbers at = from;
    do {
      for (std::uint32_t other = first_[index(at)]; other != vacant; other = next_[other]) {
        const Vec<N> apart = centres[other] - p;
        const double reach = 0.5 * (diameter + diameters_[other]);
        if (dot(apart, apart) < reach * reach) return false;
      }
    } while (next(at, from, to));
    std::uint32_t& first = first_[index(own)];
    next_[centres.size()] = std::exchange(first, static_cast<std::uint32_t>(centres.size()));
    centres.push_back(p);
    return true;
  }

 private:
  using Numbers = std::array<std::int64_t, N>;
  static constexpr std::uint32_t vacant = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] std::size_t index(const Numbers& at) const {
    std::int64_t number = at[N - 1];
    for (std::size_t axis = N - 1; axis-- > 0;) number = number * count_[axis] + at[axis];
    return static_cast<std::size_t>(number);
  }

  static bool next(Numbers& at, const Numbers& from, const Numbers& to) {
    for (std::size_t axis = 0; axis < N; ++axis) {
      if (++at[axis] <= to[axis]) return true;
      at[axis] = from[axis];
    }
    return false;
  }

  Vec<N> low_;
  double size_;
  std::span<const double> diameters_;
  Numbers count_{};
  std::vector<std::uint32_t> first_;  ///< of each cell
  std::vector<std::uint32_t> next_;   ///< of each particle, in its cell
};

/// 53 random bits: the standard fixes the generator's bits, but not what its distributions make of them.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Discs of a large slug take 2 attempts each at a solid fraction of 0.2, 13 at 0.45, 57 at 0.5, 470 to 640 at 0.53 (20
/// thousand discs, three seeds). 3000 each leave room; a slug of few discs gets some more. Beyond that it has jammed.
std::uint64_t attempt_budget(std::uint64_t count) { return 100000 + 3000 * count; }

/// A ring that refuses so many is full: beside the axis, where the slice is hardly wider than a sphere, of dense slugs.
constexpr std::uint64_t attempts_in_a_ring = 300;

[[noreturn]] void refuse(std::uint64_t asked, std::uint64_t placed, double fraction, double limit) {
  std::ostringstream text;
  text << "impactor.slug.relative_density: " << asked << " particles asked for, but after " << attempt_budget(asked)
       << " attempts only " << placed << " found a place (solid fraction " << fraction
       << "): random sequential addition jams near " << limit
       << ", less in a narrow slug; choose a smaller fraction or diameter";
  throw InputError(text.str());
}

/// Sum of the first diameters' powers.
double sum_of_powers(std::span<const double> diameters, std::size_t count, int power) {
  double sum = 0.0;
  for (const double d : diameters.first(count)) sum += std::pow(d, power);
  return sum;
}

/// 0 .. count-1 in a random order.
std::vector<std::uint32_t> shuffled(std::uint64_t count, std::mt19937_64& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  for (std::uint64_t left = count; left > 1; --left) {
    std::swap(order[left - 1], order[static_cast<std::uint64_t>(uniform(random) * static_cast<double>(left))]);
  }
  return order;
}

}  // namespace

std::vector<Vec2> pack_at_random(const PackingBox& box, std::span<const double> diameters, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::size_t count = diameters.size();
  std::vector<Vec2> centres;
  centres.reserve(count);
  Cells<2> cells(box.low, box.high, diameters);
  const std::uint64_t budget = attempt_budget(count);
  for (std::uint64_t attempt = 0; attempt < budget && centres.size() < count; ++attempt) {
    const double radius = diameters[centres.size()] / 2.0;
    Vec2 place;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double low = box.low[axis] + radius;
      place[axis] = low + uniform(random) * (box.high[axis] - radius - low);
    }
    cells.take(place, centres);
  }
  if (centres.size() < count) {
    const Vec2 size = box.high - box.low;
    const double solid = std::numbers::pi / 4.0 * sum_of_powers(diameters, centres.size(), 2);
    refuse(count, centres.size(), solid / (size[0] * size[1]), 0.547);
  }
  return centres;
}

double PackingSlice::inner(double radius) const { return radius / std::sin(0.5 * angle); }

namespace {

/// A place for a sphere in one of `count` rings.
Vec3 place_in_ring(const PackingSlice& slice, double radius, std::uint32_t ring, std::size_t count,
                   std::mt19937_64& random) {
  const double inner2 = slice.inner(radius) * slice.inner(radius);
  const double outer = slice.outer - radius;
  const double area = (outer * outer - inner2) / static_cast<double>(count);
  const double low = slice.low + radius;
  const double r = std::sqrt(inner2 + (ring + uniform(random)) * area);
  const double along = uniform(random);
  const double across = uniform(random);
  const double margin = std::asin(std::min(1.0, radius / r));
  const double theta = margin + across * std::max(0.0, slice.angle - 2.0 * margin);
  return {{r * std::cos(theta), low + along * (slice.high - radius - low), r * std::sin(theta)}};
}

}  // namespace

std::vector<Vec3> pack_at_random(const PackingSlice& slice, std::span<const double> diameters, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::size_t count = diameters.size();
  std::vector<Vec3> centres;
  centres.reserve(count);
  const double left = slice.outer * std::min(0.0, std::cos(slice.angle));
  const double widest = slice.outer * (slice.angle < 0.5 * std::numbers::pi ? std::sin(slice.angle) : 1.0);
  Cells<3> cells({{left, slice.low, 0.0}}, {{slice.outer, slice.high, widest}}, diameters);
  std::vector<std::uint32_t> rings = shuffled(count, random);
  const std::uint64_t budget = attempt_budget(count);
  std::uint64_t failed = 0;
  for (std::uint64_t attempt = 0; attempt < budget && centres.size() < count; ++attempt) {
    // The place is drawn anew until it is vacant, but stays in its ring unless that is full.
    const std::size_t next = centres.size();
    if (failed == attempts_in_a_ring) {
      rings[next] = static_cast<std::uint32_t>(uniform(random) * static_cast<double>(count));
      failed = 0;
    }
    const Vec3 place = place_in_ring(slice, diameters[next] / 2.0, rings[next], count, random);
    failed = cells.take(place, centres) ? 0 : failed + 1;
  }
  if (centres.size() < count) {
    const double volume = 0.5 * slice.angle * slice.outer * slice.outer * (slice.high - slice.low);
    refuse(count, centres.size(), std::numbers::pi / 6.0 * sum_of_powers(diameters, centres.size(), 3) / volume, 0.382);
  }
  return centres;
}

}  // namespace grainstep::dem
