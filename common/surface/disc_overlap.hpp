/// @file What a disc has in common with the structure under the surface, and how each node's motion changes it.
///
/// The measure B of the overlap is the integral over the common area of R^2 - r^2, r the distance from the disc's
/// centre. A force that derives from a potential U(B) presses on the surface with dU/dB (R^2 - r^2): strongest in the
/// middle, nothing at the edge, on a flat surface a parabola over the chord, nearly Hertz's. Node i receives -dU/dB
/// dB/dx_i, and the disc dU/dB N with N = sum of dB/dx_i = -dB/dx_disc. B does not change when disc and surface move or
/// turn together, so force and moment add up to nothing, and the work of these forces is that of the potential,
/// whatever the surface looks like in the disc: flat, dented, an edge, a fold. docs/theory/contact.md, "A particle
/// wider than an element".
#pragma once

#include <span>
#include <vector>

#include "surface/polyline.hpp"

namespace grainstep::surface {

/// One node's part in the overlap. A node that joins two segments comes twice.
struct NodeShare {
  std::uint32_t node;
  double weight;  ///< m^3, integral of its shape function times R^2 - r^2 along the surface
  Vec2 gradient;  ///< m^3, dB/dx of this node: the same, times the outward normal
};

struct DiscOverlap {
  double measure = 0.0;  ///< m^4, B
  double weight = 0.0;   ///< m^3, sum over the nodes
  Vec2 gradient;         ///< m^3, N: from the structure to the disc
};

/// Finds overlaps one after the other; keeps its memory between them.
class DiscOverlapFinder {
 public:
  /// The overlap with the disc of `radius` (m) around `centre`; nodes' shares are appended. `candidates`: at least all
  /// segments that reach into the disc. Where an open piece ends in the disc, the structure is taken to end there at a
  /// right angle; what presses on that end goes to the end's node. A disc that no segment reaches has no overlap.
  [[nodiscard]] DiscOverlap find(const Polyline& surface, const Vec2& centre, double radius,
                                 std::span<const std::uint32_t> candidates, std::vector<NodeShare>& shares);

 private:
  void segment(const Polyline& surface, const Vec2& centre, std::uint32_t index);
  void end_face(std::uint32_t node, const Vec2& at, const Vec2& normal, bool first);
  void close();

  double radius_ = 0.0;
  std::vector<NodeShare>* shares_ = nullptr;
  DiscOverlap found_;
  std::vector<Vec2> entries_, exits_;  ///< where the surface enters and leaves the disc, from its centre
};

/// The overlap that a flat surface would have at the same measure.
struct FlatOverlap {
  double depth = 0.0;        ///< m, delta
  double per_measure = 0.0;  ///< 1/m^3, d delta/dB
};
/// `measure` above 0.
[[nodiscard]] FlatOverlap flat_overlap(double measure, double radius);

/// m, over all segments as they are now.
[[nodiscard]] double mean_length(const Polyline& surface);

}  // namespace grainstep::surface
