#include "ledger/surface_load.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "surface/vec.hpp"

namespace grainstep::ledger {

SurfaceLoad::SurfaceLoad(const wire::Surface& surface, double depth) : SurfaceLoad(surface, Shape::extruded, depth) {}

SurfaceLoad SurfaceLoad::of_revolution(const wire::Surface& surface) { return {surface, Shape::revolved, 0.0}; }

/// Area and weights. The integral of a shape function over a ring: 2 pi length (2 r + r of the other node)/6.
void SurfaceLoad::measure_segment(Facet& segment, const double (&radius)[2], Shape shape, double depth) {
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

/// The facet whose node numbers begin at `first`, with nothing but these.
SurfaceLoad::Facet SurfaceLoad::named(const wire::Surface& surface, int first) const {
  Facet facet{};
  const int n = static_cast<int>(dimension_);
  for (int k = 0; k < n; ++k) {
    facet.node[k] = surface.facet(first + k);
    if (facet.node[k] >= nodes_) {
      throw InputError("surface: facet " + std::to_string(first / n) + " names node " + std::to_string(facet.node[k]) +
                       ", but there are positions for " + std::to_string(nodes_) + " nodes");
    }
  }
  return facet;
}

SurfaceLoad::Facet SurfaceLoad::segment(const wire::Surface& surface, int first, Shape shape, double depth) const {
  Facet segment = named(surface, first);
  const auto at = [&](int k, int axis) { return surface.position(static_cast<int>(2 * segment.node[k]) + axis); };
  const double tangent[2] = {at(1, 0) - at(0, 0), at(1, 1) - at(0, 1)};
  segment.length = std::hypot(tangent[0], tangent[1]);
  if (!(segment.length > 0.0)) {
    throw InputError("surface: segment " + std::to_string(first / 2) + " has length " + std::to_string(segment.length));
  }
  segment.normal[0] = -tangent[1] / segment.length;  // the tangent turned by +90 degrees
  segment.normal[1] = tangent[0] / segment.length;
  for (int axis = 0; axis < 2; ++axis) segment.middle[axis] = 0.5 * (at(0, axis) + at(1, axis));
  measure_segment(segment, {at(0, 0), at(1, 0)}, shape, depth);
  return segment;
}

SurfaceLoad::Facet SurfaceLoad::triangle(const wire::Surface& surface, int first) const {
  Facet triangle = named(surface, first);
  surface::Vec3 corner[3];
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      corner[k][axis] = surface.position(static_cast<int>(3 * triangle.node[k]) + axis);
    }
  }
  const surface::Vec3 twice = cross(corner[1] - corner[0], corner[2] - corner[0]);  // area vector, outward
  triangle.area = 0.5 * norm(twice);
  if (!(triangle.area > 0.0)) {
    throw InputError("surface: triangle " + std::to_string(first / 3) + " has area " + std::to_string(triangle.area));
  }
  for (int axis = 0; axis < 3; ++axis) {
    triangle.normal[axis] = 0.5 * twice[axis] / triangle.area;
    triangle.middle[axis] = (corner[0][axis] + corner[1][axis] + corner[2][axis]) / 3.0;
    triangle.weight[axis] = triangle.area / 3.0;  // of each of its nodes
  }
  return triangle;
}

SurfaceLoad::SurfaceLoad(const wire::Surface& surface, Shape shape, double depth)
    : dimension_(surface.dimension() == 3 ? 3 : 2),
      nodes_(static_cast<std::size_t>(surface.position_size()) / dimension_) {
  const int n = static_cast<int>(dimension_);
  std::vector<double> tributary(values(), 0.0);
  for (int first = 0; first + n <= surface.facet_size(); first += n) {
    const Facet facet = n == 3 ? triangle(surface, first) : segment(surface, first, shape, depth);
    for (int k = 0; k < n; ++k) {
      for (int axis = 0; axis < n; ++axis) tributary[dimension_ * facet.node[k] + axis] += facet.seen_along(axis, k);
    }
    facets_.push_back(facet);
  }
  for (Facet& facet : facets_) {
    for (int k = 0; k < n; ++k) {
      for (int axis = 0; axis < n; ++axis) {
        const double all = tributary[dimension_ * facet.node[k] + axis];
        facet.share[k][axis] = all > 0.0 ? facet.seen_along(axis, k) / all : 0.0;
      }
    }
  }
}

std::vector<double> SurfaceLoad::midpoints() const {
  std::vector<double> out;
  for (const Facet& facet : facets_) out.push_back(facet.middle[0]);
  return out;
}

std::vector<double> SurfaceLoad::middles() const {
  std::vector<double> out;
  for (const Facet& facet : facets_) out.insert(out.end(), facet.middle, facet.middle + dimension_);
  return out;
}

std::vector<double> SurfaceLoad::lengths() const {
  std::vector<double> out;
  for (const Facet& facet : facets_) out.push_back(facet.length);
  return out;
}

std::vector<double> SurfaceLoad::areas() const {
  std::vector<double> out;
  for (const Facet& facet : facets_) out.push_back(facet.area);
  return out;
}

double SurfaceLoad::area_of_face() const {
  double sum = 0.0;
  for (const Facet& facet : facets_) sum += facet.of_loaded_face() ? facet.area : 0.0;
  return sum;
}

double SurfaceLoad::pressed(const Facet& facet, std::span<const double> impulse) const {
  const int n = static_cast<int>(dimension_);
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    const std::size_t first = dimension_ * facet.node[k];
    for (int axis = 0; axis < n; ++axis) sum -= facet.share[k][axis] * impulse[first + axis] * facet.normal[axis];
  }
  return sum;
}

std::vector<double> SurfaceLoad::impulse_per_area(std::span<const double> impulse) const {
  std::vector<double> out;
  out.reserve(facets_.size());
  for (const Facet& facet : facets_) {
    out.push_back(pressed(facet, impulse) / facet.area);
  }
  return out;
}

double SurfaceLoad::impulse_on_face(std::span<const double> impulse) const {
  double sum = 0.0;
  for (const Facet& facet : facets_) {
    if (!facet.of_loaded_face()) continue;
    double pressing = 0.0;
    for (std::size_t k = 0; k < dimension_; ++k) {
      pressing -= facet.share[k][1] * impulse[dimension_ * facet.node[k] + 1];
    }
    sum += pressing;
  }
  return sum;
}

}  // namespace grainstep::ledger
