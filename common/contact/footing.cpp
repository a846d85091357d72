#include "contact/footing.hpp"

namespace grainstep::contact {

using surface::Vec2;

Foot Footing::over_chord(const MovingSurface& surface, const Vec2& centre, double radius,
                         std::span<const std::uint32_t> candidates, const surface::ClosestPoint& closest) {
  Foot foot{.at = closest, .first = shares_.size(), .last = shares_.size()};
  // B goes with the overlap to the power 5/2: of a first touch it is round-off, and its chord is a point.
  constexpr double first_touch = 1e-6;  // of the radius
  if (radius - closest.distance < first_touch * radius) return foot;
  const surface::DiscOverlap overlap = finder_.find(surface.now(), centre, radius, candidates, shares_);
  foot.pressed = norm(overlap.gradient);
  // All in common: no direction to press in.
  constexpr double negligible = 1e-12;  // of the radius cubed
  if (!(overlap.measure > 0.0) || !(foot.pressed > negligible * radius * radius * radius)) {
    shares_.resize(foot.first);
    return foot;
  }
  foot.last = shares_.size();
  foot.weight = overlap.weight;
  const surface::FlatOverlap flat = surface::flat_overlap(overlap.measure, radius);
  foot.at.distance = radius - flat.depth;
  foot.at.normal = overlap.gradient * (1.0 / foot.pressed);
  foot.gain = foot.pressed * flat.per_measure;
  Vec2 middle;
  for (const surface::NodeShare& share : shares_of(foot)) middle += share.weight * surface.now().nodes()[share.node];
  foot.lever = dot(centre - middle * (1.0 / foot.weight), foot.at.normal);
  return foot;
}

Vec2 Footing::velocity(const MovingSurface& surface, const Foot& foot) const {
  if (foot.is_point()) return surface.now().interpolate(surface.velocity(), foot.at);
  Vec2 mean;
  double along = 0.0;
  for (const surface::NodeShare& share : shares_of(foot)) {
    const Vec2& v = surface.velocity()[share.node];
    mean += share.weight * v;
    along += dot(share.gradient, v);
  }
  mean *= 1.0 / foot.weight;
  return mean + (along / foot.pressed - dot(mean, foot.at.normal)) * foot.at.normal;
}

void Footing::give(const MovingSurface& surface, const Foot& foot, const Vec2& impulse, std::span<Vec2> nodal) const {
  if (foot.is_point()) {
    surface.now().spread(impulse, foot.at, nodal);
    return;
  }
  const double normal = dot(impulse, foot.at.normal);
  const Vec2 tangential = impulse - normal * foot.at.normal;
  for (const surface::NodeShare& share : shares_of(foot)) {
    nodal[share.node] += (normal / foot.pressed) * share.gradient + (share.weight / foot.weight) * tangential;
  }
}

}  // namespace grainstep::contact
