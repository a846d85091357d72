#include "fe-service/load/loaded_patch.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace grainstep::fe {

LoadedPatch::LoadedPatch(const wire::Surface& surface, const scene::Pressure& pressure) {
  for (int s = 0; s + 1 < surface.facet_size(); s += 2) {
    const std::uint32_t nodes[] = {surface.facet(s), surface.facet(s + 1)};
    const auto at = [&](int end) {
      if (2 * std::uint64_t{nodes[end]} + 1 >= static_cast<std::uint64_t>(surface.position_size()))
        throw InputError("surface: a segment names a node without a position");
      const int i = static_cast<int>(2 * nodes[end]);
      return Vec2{surface.position(i), surface.position(i + 1)};
    };
    const Vec2 along = at(1) - at(0);  // the outward normal is this, turned by +90 degrees: (-y, x)
    if (!(along.x > std::abs(along.y))) continue;
    const double left = at(0).x;
    double from = left;
    double to = at(1).x;
    if (pressure.has_patch()) {
      from = std::max(from, pressure.patch().from());
      to = std::min(to, pressure.patch().to());
    }
    if (!(to > from)) continue;
    parts_.push_back({nodes[0], nodes[1], (to - from) / along.x, (0.5 * (from + to) - left) / along.x, to - from});
  }
  if (parts_.empty()) throw InputError("impactor.pressure.patch: no part of the structure's loaded face lies in it");
}

double LoadedPatch::width() const {
  double sum = 0.0;
  for (const Part& part : parts_) sum += part.width;
  return sum;
}

void LoadedPatch::press(double impulse, const Measure& measure, std::span<const double> position,
                        std::span<double> nodal) const {
  for (const Part& part : parts_) {
    const std::size_t a = std::size_t{2} * part.first;
    const std::size_t b = std::size_t{2} * part.second;
    const double grows = is_of_revolution(measure) ? position[b] - position[a] : 0.0;
    const double radius = position[a] + part.middle * grows;
    // Where the resultant stands: of rings r(s), integral of s r over that of r.
    const double at = grows == 0.0 ? part.middle : part.middle + grows * part.share * part.share / (12.0 * radius);
    const double scale = impulse * thickness(measure, radius) * part.share;
    const Vec2 given{scale * (position[b + 1] - position[a + 1]), -scale * (position[b] - position[a])};
    nodal[a] += (1.0 - at) * given.x;
    nodal[a + 1] += (1.0 - at) * given.y;
    nodal[b] += at * given.x;
    nodal[b + 1] += at * given.y;
  }
}

}  // namespace grainstep::fe
