#include "contact/rest_on.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/assert.hpp"
#include "base/error.hpp"

namespace grainstep::contact {

using surface::Vec2;

void rest_on(const surface::Polyline& surface, std::span<const double> radii, std::vector<Vec2>& centres) {
  std::vector<std::uint32_t> all(surface.segment_count());
  std::iota(all.begin(), all.end(), 0U);
  GS_ASSERT(radii.size() == 1 || radii.size() == centres.size(), "as many radii as discs");
  const auto radius = [&](std::size_t i) { return radii[radii.size() == 1 ? 0 : i]; };
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  double left_end = std::numeric_limits<double>::infinity();
  double right_end = -std::numeric_limits<double>::infinity();
  for (const Vec2& node : surface.nodes()) {
    top = std::max(top, node[1]);
    bottom = std::min(bottom, node[1]);
    left_end = std::min(left_end, node[0]);
    right_end = std::max(right_end, node[0]);
  }
  bool any_above = false;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    any_above = any_above || (centres[i][0] >= left_end - radius(i) && centres[i][0] <= right_end + radius(i));
  }
  const char* const beside = "impactor.slug: nothing of it stands above the structure's surface";
  if (!any_above) throw InputError(beside);
  std::size_t lowest = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (centres[i][1] - centres[lowest][1] < radius(i) - radius(lowest)) lowest = i;
  }
  const double shift = centres.empty() ? 0.0 : top + radius(lowest) - centres[lowest][1];
  for (Vec2& p : centres) p[1] += shift;
  const auto smallest_gap = [&] {
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const Vec2& p = centres[i];
      if (p[1] - top - radius(i) > gap) continue;  // higher above the highest node than the gap found so far
      gap = std::min(gap, surface.closest(p, all).distance - radius(i));
    }
    return gap;
  };
  // Once all are below the whole surface, they have passed beside it and would sink for ever.
  const auto all_below = [&] { return std::ranges::all_of(centres, [&](const Vec2& p) { return p[1] < bottom; }); };
  // Every disc may sink by the smallest gap without touching, since a distance changes no faster than the disc moves.
  // Repeated, this converges to first contact from above. A billionth of a diameter is left, so that round-off cannot
  // make an overlap of it.
  const double left = 2e-9 * std::ranges::min(radii);
  constexpr int many = 100000;
  for (int i = 0; i < many; ++i) {
    const double sink = smallest_gap() - left;
    if (std::abs(sink) <= 0.5 * left) return;
    if (!std::isfinite(sink) || (sink > 0.0 && all_below())) break;
    for (Vec2& p : centres) p[1] -= sink;
  }
  throw InputError(beside);
}

}  // namespace grainstep::contact
