#include "contact/rest_on.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"

namespace grainstep::contact {

using surface::Vec2;

void rest_on(const surface::Polyline& surface, double diameter, std::vector<Vec2>& centres) {
  std::vector<std::uint32_t> all(surface.segment_count());
  std::iota(all.begin(), all.end(), 0U);
  const double radius = diameter / 2.0;
  double top = -std::numeric_limits<double>::infinity();
  for (const Vec2& node : surface.nodes()) top = std::max(top, node[1]);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec2& p : centres) lowest = std::min(lowest, p[1]);
  for (Vec2& p : centres) p[1] += top + radius - lowest;
  const auto smallest_gap = [&] {
    double gap = std::numeric_limits<double>::infinity();
    for (const Vec2& p : centres) {
      if (p[1] - top - radius > gap) continue;  // higher above the highest node than the gap found so far
      gap = std::min(gap, surface.closest(p, all).distance - radius);
    }
    return gap;
  };
  // Every disc may sink by the smallest gap without touching, since a distance changes no faster than the disc moves.
  // Repeated, this converges to first contact from above. A billionth of a diameter is left, so that round-off cannot
  // make an overlap of it.
  const double left = 1e-9 * diameter;
  constexpr int many = 100000;
  for (int i = 0; i < many; ++i) {
    const double sink = smallest_gap() - left;
    if (std::abs(sink) <= 0.5 * left) return;
    if (!std::isfinite(sink)) break;
    for (Vec2& p : centres) p[1] -= sink;
  }
  throw InputError("impactor.slug: nothing of it stands above the structure's surface");
}

}  // namespace grainstep::contact
