/// @file The touchable surface in two dimensions: segments joined at nodes, its closest point to a particle's centre.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/vec.hpp"

namespace grainstep::surface {

/// The surface point closest to a given point p.
struct ClosestPoint {
  std::uint32_t segment = 0;
  double fraction = 0.0;  ///< 0 at the segment's first node, 1 at its second
  double distance = 0.0;  ///< m, signed: positive outside the structure, negative inside it
  Vec2 normal;            ///< unit, points out of the structure; p = point + distance * normal
};

/// Segments that share nodes. Walking a segment from its first to its second node the structure lies to the right:
/// the outward normal is the tangent turned by +90 degrees. At a node at most one segment ends and one begins; pieces
/// may be open or closed, and there may be several.
class Polyline {
 public:
  using Segment = std::array<std::uint32_t, 2>;

  /// Throws InputError when a segment names a node that does not exist, has no length, or branches off at a node.
  Polyline(std::vector<Vec2> nodes, std::vector<Segment> segments);

  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
  [[nodiscard]] std::size_t segment_count() const { return segments_.size(); }
  [[nodiscard]] std::span<const Vec2> nodes() const { return nodes_; }
  [[nodiscard]] std::span<Vec2> nodes() { return nodes_; }  ///< m; move them at will, the topology stays
  [[nodiscard]] const Segment& segment(std::uint32_t index) const { return segments_[index]; }

  [[nodiscard]] double length(std::uint32_t segment) const { return norm(tangent(segment)); }  ///< m, now

  /// The segment that ends where this one begins, or begins where it ends; none at the end of an open piece.
  [[nodiscard]] std::optional<std::uint32_t> before(std::uint32_t segment) const { return known(before_[segment]); }
  [[nodiscard]] std::optional<std::uint32_t> after(std::uint32_t segment) const { return known(after_[segment]); }

  /// Squared distance of p to a segment, m^2.
  [[nodiscard]] double squared_distance(const Vec2& p, std::uint32_t segment) const;

  /// THE closest point among `candidates` (not empty): exactly one, also at corners, folds and joints. At a convex
  /// corner the normal points from the corner to p; of two equally close segments the first of the candidates wins.
  /// Beyond the end of an open piece p counts as outside.
  [[nodiscard]] ClosestPoint closest(const Vec2& p, std::span<const std::uint32_t> candidates) const;

  /// A nodal vector field at a surface point (linear shape functions).
  [[nodiscard]] Vec2 interpolate(std::span<const Vec2> field, const ClosestPoint& at) const {
    const auto [first, second] = segments_[at.segment];
    return (1.0 - at.fraction) * field[first] + at.fraction * field[second];
  }

  /// Adds a force or impulse at a surface point to the two nodes of its segment: keeps its sum and its moment.
  void spread(const Vec2& force, const ClosestPoint& at, std::span<Vec2> nodal) const {
    const auto [first, second] = segments_[at.segment];
    nodal[first] += (1.0 - at.fraction) * force;
    nodal[second] += at.fraction * force;
  }

 private:
  static constexpr std::int64_t none = -1;
  [[nodiscard]] static std::optional<std::uint32_t> known(std::int64_t segment) {
    return segment == none ? std::nullopt : std::optional(static_cast<std::uint32_t>(segment));
  }

  [[nodiscard]] Vec2 tangent(std::uint32_t segment) const;      ///< not normalised
  [[nodiscard]] Vec2 unit_normal(std::uint32_t segment) const;  ///< outward
  [[nodiscard]] ClosestPoint at_vertex(const Vec2& p, std::uint32_t segment, bool at_end) const;

  std::vector<Vec2> nodes_;
  std::vector<Segment> segments_;
  std::vector<std::int64_t> before_;  ///< segment that ends where this one begins, or none
  std::vector<std::int64_t> after_;   ///< segment that begins where this one ends, or none
};

}  // namespace grainstep::surface
