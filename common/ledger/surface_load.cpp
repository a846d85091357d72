#include "ledger/surface_load.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"

namespace grainstep::ledger {

SurfaceLoad::SurfaceLoad(const wire::Surface& surface, double depth) : SurfaceLoad(surface, Shape::extruded, depth) {}

SurfaceLoad SurfaceLoad::of_revolution(const wire::Surface& surface) { return {surface, Shape::revolved, 0.0}; }

/// Area and weights. The integral of a shape function over a ring: 2 pi length (2 r + r of the other node)/6.
void SurfaceLoad::measure(Segment& segment, const double (&radius)[2], Shape shape, double depth) {
  if (shape == Shape::extruded) {
    segment.area = segment.length * depth;
    segment.weight[0] = segment.weight[1] = segment.length;
    return;
  }
  segment.area = segment.length * std::numbers::pi * (radius[0] + radius[1]);
  if (!(segment.area > 0.0)) {
    throw InputError("surface: the segment between nodes " + std::to_string(segment.node[0]) + " and " +
                     std::to_string(segment.node[1]) + " of a surface of revolution has no area");
  }
  for (int k = 0; k < 2; ++k) {
    segment.weight[k] = segment.length * std::numbers::pi / 3.0 * (2.0 * radius[k] + radius[1 - k]);
  }
}

SurfaceLoad::SurfaceLoad(const wire::Surface& surface, Shape shape, double depth)
    : nodes_(static_cast<std::size_t>(surface.position_size()) / 2) {
  std::vector<double> tributary(2 * nodes_, 0.0);
  for (int s = 0; s + 1 < surface.segment_size(); s += 2) {
    Segment segment{};
    for (int k = 0; k < 2; ++k) {
      segment.node[k] = surface.segment(s + k);
      if (segment.node[k] >= nodes_) {
        throw InputError("surface: segment " + std::to_string(s / 2) + " names node " +
                         std::to_string(segment.node[k]) + ", but there are positions for " + std::to_string(nodes_) +
                         " nodes");
      }
    }
    const auto at = [&](int k, int axis) { return surface.position(static_cast<int>(2 * segment.node[k]) + axis); };
    const double tangent[2] = {at(1, 0) - at(0, 0), at(1, 1) - at(0, 1)};
    segment.length = std::hypot(tangent[0], tangent[1]);
    if (!(segment.length > 0.0)) {
      throw InputError("surface: segment " + std::to_string(s / 2) + " has length " + std::to_string(segment.length));
    }
    segment.normal[0] = -tangent[1] / segment.length;  // the tangent turned by +90 degrees
    segment.normal[1] = tangent[0] / segment.length;
    segment.middle = 0.5 * (at(0, 0) + at(1, 0));
    measure(segment, {at(0, 0), at(1, 0)}, shape, depth);
    for (int k = 0; k < 2; ++k) {
      for (int axis = 0; axis < 2; ++axis) tributary[2 * segment.node[k] + axis] += segment.seen_along(axis, k);
    }
    segments_.push_back(segment);
  }
  for (Segment& segment : segments_) {
    for (int k = 0; k < 2; ++k) {
      for (int axis = 0; axis < 2; ++axis) {
        const double all = tributary[2 * segment.node[k] + axis];
        segment.share[k][axis] = all > 0.0 ? segment.seen_along(axis, k) / all : 0.0;
      }
    }
  }
}

std::vector<double> SurfaceLoad::midpoints() const {
  std::vector<double> out;
  for (const Segment& segment : segments_) {
    out.push_back(segment.middle);
  }
  return out;
}

std::vector<double> SurfaceLoad::lengths() const {
  std::vector<double> out;
  for (const Segment& segment : segments_) {
    out.push_back(segment.length);
  }
  return out;
}

double SurfaceLoad::pressed(const Segment& segment, std::span<const double> impulse) {
  double sum = 0.0;
  for (int k = 0; k < 2; ++k) {
    const std::size_t first = 2 * segment.node[k];
    for (int axis = 0; axis < 2; ++axis) sum -= segment.share[k][axis] * impulse[first + axis] * segment.normal[axis];
  }
  return sum;
}

std::vector<double> SurfaceLoad::impulse_per_area(std::span<const double> impulse) const {
  std::vector<double> out;
  out.reserve(segments_.size());
  for (const Segment& segment : segments_) {
    out.push_back(pressed(segment, impulse) / segment.area);
  }
  return out;
}

double SurfaceLoad::impulse_on_face(std::span<const double> impulse) const {
  double sum = 0.0;
  for (const Segment& segment : segments_) {
    if (!segment.of_loaded_face()) continue;
    double pressing = 0.0;
    for (int k = 0; k < 2; ++k) pressing -= segment.share[k][1] * impulse[2 * segment.node[k] + 1];
    sum += pressing;
  }
  return sum;
}

}  // namespace grainstep::ledger
