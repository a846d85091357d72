#include "participant/check_surface.hpp"

#include <cmath>

namespace grainstep::participant {
namespace {

using Problem = std::optional<std::string>;
using Values = google::protobuf::RepeatedField<double>;

Problem length_problem(const char* what, const Values& values, int expected) {
  if (values.size() == expected) return std::nullopt;
  return std::string(".").append(what) + " holds " + std::to_string(values.size()) + " numbers, expected " +
         std::to_string(expected) + ": as many as the other, a multiple of the dimension";
}

Problem number_problem(const char* what, const Values& values) {
  for (int i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    return std::string(".").append(what) + "[" + std::to_string(i) + "] = " + std::to_string(values[i]) +
           "; it must be a number";
  }
  return std::nullopt;
}

/// Length of a segment, twice the area of a triangle.
double extent_of(const wire::Surface& surface, int first) {
  const auto n = static_cast<int>(surface.dimension());
  double edge[2][3] = {};
  for (int k = 1; k < n; ++k) {
    for (int c = 0; c < n; ++c) {
      edge[k - 1][c] = surface.position(n * static_cast<int>(surface.facet(first + k)) + c) -
                       surface.position(n * static_cast<int>(surface.facet(first)) + c);
    }
  }
  if (n == 2) return std::hypot(edge[0][0], edge[0][1]);
  const auto cross = [&](int a, int b) { return edge[0][a] * edge[1][b] - edge[0][b] * edge[1][a]; };
  return std::hypot(cross(1, 2), cross(2, 0), cross(0, 1));
}

Problem facet_problem(const wire::Surface& surface, unsigned nodes) {
  const auto n = static_cast<int>(surface.dimension());
  if (surface.facet_size() == 0 || surface.facet_size() % n != 0) {
    return ".facet holds " + std::to_string(surface.facet_size()) + " node numbers, expected " + std::to_string(n) +
           " for each facet, and one facet at least";
  }
  for (int i = 0; i < surface.facet_size(); ++i) {
    if (surface.facet(i) < nodes) continue;
    return ": facet " + std::to_string(i / n) + " names node " + std::to_string(surface.facet(i)) +
           ", but the surface has " + std::to_string(nodes) + " nodes, counted from 0";
  }
  for (int i = 0; i < surface.facet_size(); i += n) {
    const double extent = extent_of(surface, i);
    if (extent > 0.0 && std::isfinite(extent)) continue;
    return ": facet " + std::to_string(i / n) + " has no " + (n == 2 ? "length" : "area") +
           (extent > 0.0 ? " that is a number" : "");
  }
  return std::nullopt;
}

}  // namespace

Problem surface_problem(const wire::Surface& surface, unsigned dimension) {
  if (surface.dimension() != dimension || (dimension != 2 && dimension != 3)) {
    return " has dimension " + std::to_string(surface.dimension()) + ", the run has " + std::to_string(dimension);
  }
  const int size = surface.position_size();
  if (size == 0) return " has no nodes: there would be nothing to touch";
  const auto n = static_cast<int>(dimension);
  if (auto found = length_problem("position", surface.position(), size - size % n)) return found;
  if (auto found = length_problem("velocity", surface.velocity(), size)) return found;
  if (auto found = number_problem("position", surface.position())) return found;
  if (auto found = number_problem("velocity", surface.velocity())) return found;
  return facet_problem(surface, static_cast<unsigned>(size / n));
}

}  // namespace grainstep::participant
