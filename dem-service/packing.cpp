#include "dem-service/packing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>

#include "base/error.hpp"

namespace grainstep::dem {
namespace {

using surface::Vec;
using surface::Vec2;
using surface::Vec3;

/// Cells so small (diameter/sqrt(N)) that each holds at most one centre.
template <std::size_t N>
class Cells {
 public:
  Cells(const Vec<N>& low, const Vec<N>& high, double diameter)
      : low_(low), size_(diameter / std::sqrt(static_cast<double>(N))), diameter_(diameter) {
    std::int64_t cells = 1;
    for (std::size_t axis = 0; axis < N; ++axis) {
      count_[axis] = static_cast<std::int64_t>((high[axis] - low[axis]) / size_) + 1;
      cells *= count_[axis];
    }
    taken_.assign(static_cast<std::size_t>(cells), vacant);
  }

  /// Takes the place if no centre is closer than the diameter.
  bool take(const Vec<N>& p, std::vector<Vec<N>>& centres) {
    Numbers own;
    Numbers from;
    Numbers to;
    for (std::size_t axis = 0; axis < N; ++axis) {
      own[axis] = std::min(static_cast<std::int64_t>((p[axis] - low_[axis]) / size_), count_[axis] - 1);
      from[axis] = std::max<std::int64_t>(0, own[axis] - 2);
      to[axis] = std::min(own[axis] + 2, count_[axis] - 1);
    }
    Numbers at = from;
    do {
      const std::uint32_t other = taken_[index(at)];
      if (other == vacant) continue;
      const Vec<N> apart = centres[other] - p;
      if (dot(apart, apart) < diameter_ * diameter_) return false;
    } while (next(at, from, to));
    taken_[index(own)] = static_cast<std::uint32_t>(centres.size());
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
  double diameter_;
  Numbers count_{};
  std::vector<std::uint32_t> taken_;
};

/// 53 random bits: the standard fixes the generator's bits, but not what its distributions make of them.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Discs of a large slug take 2 attempts each at a solid fraction of 0.2, 13 at 0.45, 57 at 0.5, 470 to 640 at 0.53 (20
/// thousand discs, three seeds). 3000 each leave room; a slug of few discs gets some more. Beyond that it has jammed.
std::uint64_t attempt_budget(std::uint64_t count) { return 100000 + 3000 * count; }

/// A ring that refuses so many is full: beside the axis, where the slice is hardly wider than a sphere, of dense slugs.
constexpr std::uint64_t attempts_in_a_ring = 300;

/// What was asked for and what has become of it, for the message.
struct Jam {
  std::uint64_t asked = 0, placed = 0;
  double fraction_of_one = 0.0;
  double limit = 0.0;
};

[[noreturn]] void refuse(const Jam& jam) {
  std::ostringstream text;
  text << "impactor.slug.relative_density: " << jam.asked << " particles asked for, but after "
       << attempt_budget(jam.asked) << " attempts only " << jam.placed << " found a place (solid fraction "
       << static_cast<double>(jam.placed) * jam.fraction_of_one << "): random sequential addition jams near "
       << jam.limit << ", less in a narrow slug; choose a smaller fraction or diameter";
  throw InputError(text.str());
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

std::vector<Vec2> pack_at_random(const PackingBox& box, std::uint64_t count, double diameter, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Vec2> centres;
  centres.reserve(count);
  Cells<2> cells(box.low, box.high, diameter);
  const Vec2 size = box.high - box.low;
  const std::uint64_t budget = attempt_budget(count);
  for (std::uint64_t attempt = 0; attempt < budget && centres.size() < count; ++attempt) {
    const double x = uniform(random);
    const double y = uniform(random);
    cells.take({{box.low[0] + x * size[0], box.low[1] + y * size[1]}}, centres);
  }
  if (centres.size() < count) {
    const double area = (size[0] + diameter) * (size[1] + diameter);
    const double section = std::numbers::pi * diameter * diameter / 4.0;
    refuse({count, centres.size(), section / area, 0.547});
  }
  return centres;
}

double PackingSlice::inner() const { return wall_gap / std::sin(0.5 * angle); }

std::vector<Vec3> pack_at_random(const PackingSlice& slice, std::uint64_t count, double diameter, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Vec3> centres;
  centres.reserve(count);
  const double inner2 = slice.inner() * slice.inner();
  const double ring = (slice.outer * slice.outer - inner2) / static_cast<double>(count);
  const double left = slice.outer * std::min(0.0, std::cos(slice.angle));
  const double widest = slice.outer * (slice.angle < 0.5 * std::numbers::pi ? std::sin(slice.angle) : 1.0);
  Cells<3> cells({{left, slice.low, 0.0}}, {{slice.outer, slice.high, widest}}, diameter);
  std::vector<std::uint32_t> rings = shuffled(count, random);
  const std::uint64_t budget = attempt_budget(count);
  std::uint64_t failed = 0;
  for (std::uint64_t attempt = 0; attempt < budget && centres.size() < count; ++attempt) {
    // The place is drawn anew until it is vacant, but stays in its ring unless that is full.
    if (failed == attempts_in_a_ring) {
      rings[centres.size()] = static_cast<std::uint32_t>(uniform(random) * static_cast<double>(count));
      failed = 0;
    }
    const double r = std::sqrt(inner2 + (rings[centres.size()] + uniform(random)) * ring);
    const double along = uniform(random);
    const double across = uniform(random);
    const double margin = std::asin(std::min(1.0, slice.wall_gap / r));
    const double theta = margin + across * std::max(0.0, slice.angle - 2.0 * margin);
    const Vec3 place{{r * std::cos(theta), slice.low + along * (slice.high - slice.low), r * std::sin(theta)}};
    failed = cells.take(place, centres) ? 0 : failed + 1;
  }
  if (centres.size() < count) {
    const double radius = slice.outer + 0.5 * diameter;
    const double volume = 0.5 * slice.angle * radius * radius * (slice.high - slice.low + diameter);
    refuse({count, centres.size(), std::numbers::pi / 6.0 * diameter * diameter * diameter / volume, 0.382});
  }
  return centres;
}

}  // namespace grainstep::dem
