#include "surface/polyline.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "base/error.hpp"

namespace grainstep::surface {
namespace {

/// Divided, not multiplied by the reciprocal, which rounds twice: the normal of a segment along an axis is exact.
Vec2 over(const Vec2& a, double length) { return {{a[0] / length, a[1] / length}}; }

[[noreturn]] void refuse(std::size_t segment, const std::string& what) {
  throw InputError("surface, segment " + std::to_string(segment) + ": " + what);
}

}  // namespace

Polyline::Polyline(std::vector<Vec2> nodes, std::vector<Segment> segments)
    : nodes_(std::move(nodes)),
      segments_(std::move(segments)),
      before_(segments_.size(), none),
      after_(segments_.size(), none) {
  std::vector<std::int64_t> begins(nodes_.size(), none);
  std::vector<std::int64_t> ends(nodes_.size(), none);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto [first, second] = segments_[i];
    if (first >= nodes_.size() || second >= nodes_.size()) {
      refuse(i, "names node " + std::to_string(std::max(first, second)) + " of " + std::to_string(nodes_.size()));
    }
    if (!(norm(nodes_[second] - nodes_[first]) > 0.0)) refuse(i, "has no length");
    if (begins[first] != none || ends[second] != none) {
      refuse(i, "branches off: at a node at most one segment may end and one begin");
    }
    begins[first] = static_cast<std::int64_t>(i);
    ends[second] = static_cast<std::int64_t>(i);
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    before_[i] = ends[segments_[i][0]];
    after_[i] = begins[segments_[i][1]];
  }
}

Vec2 Polyline::tangent(std::uint32_t segment) const {
  const auto [first, second] = segments_[segment];
  return nodes_[second] - nodes_[first];
}

Vec2 Polyline::unit_normal(std::uint32_t segment) const {
  const Vec2 t = tangent(segment);
  return over(turned_left(t), norm(t));
}

namespace {

/// Where on the line a + t (b - a) the point closest to p lies, clamped to the segment.
double clamped_fraction(const Vec2& p, const Vec2& a, const Vec2& t) {
  return std::clamp(dot(p - a, t) / dot(t, t), 0.0, 1.0);
}

}  // namespace

double Polyline::squared_distance(const Vec2& p, std::uint32_t segment) const {
  const Vec2& a = nodes_[segments_[segment][0]];
  const Vec2 t = tangent(segment);
  const Vec2 apart = p - a - clamped_fraction(p, a, t) * t;
  return dot(apart, apart);
}

ClosestPoint Polyline::at_vertex(const Vec2& p, std::uint32_t segment, bool at_end) const {
  const Vec2& vertex = nodes_[segments_[segment][at_end ? 1 : 0]];
  const std::int64_t neighbour = at_end ? after_[segment] : before_[segment];
  const Vec2 own = unit_normal(segment);
  ClosestPoint found{segment, at_end ? 1.0 : 0.0, 0.0, own};
  const Vec2 apart = p - vertex;
  const double length = norm(apart);
  // The sum of the two normals tells inside from outside at a joint, where each alone may err.
  const Vec2 outward = neighbour == none ? own : own + unit_normal(static_cast<std::uint32_t>(neighbour));
  const double outward_length = norm(outward);
  constexpr double on_the_vertex = 1e-12;  // of the segment's length: no direction can be taken from round-off
  if (length <= on_the_vertex * norm(tangent(segment))) {
    if (outward_length > on_the_vertex) found.normal = over(outward, outward_length);
    return found;
  }
  const bool outside = neighbour == none || dot(apart, outward) >= 0.0;
  found.distance = outside ? length : -length;
  found.normal = over(apart, found.distance);
  return found;
}

ClosestPoint Polyline::closest(const Vec2& p, std::span<const std::uint32_t> candidates) const {
  std::uint32_t best = candidates.front();
  double best_squared = std::numeric_limits<double>::infinity();
  double best_fraction = 0.0;
  for (const std::uint32_t candidate : candidates) {
    const Vec2& a = nodes_[segments_[candidate][0]];
    const Vec2 t = tangent(candidate);
    const double fraction = clamped_fraction(p, a, t);
    const Vec2 apart = p - a - fraction * t;
    const double squared = dot(apart, apart);
    if (squared < best_squared) {
      best = candidate;
      best_squared = squared;
      best_fraction = fraction;
    }
  }
  if (best_fraction <= 0.0) return at_vertex(p, best, false);
  if (best_fraction >= 1.0) return at_vertex(p, best, true);
  const Vec2 normal = unit_normal(best);
  return {best, best_fraction, dot(p - nodes_[segments_[best][0]], normal), normal};
}

}  // namespace grainstep::surface
