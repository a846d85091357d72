/// @file Where and how a particle feels the surface: at the closest point, or over the chord that its overlap cuts.
///
/// At a point: the overlap is the radius less the distance, and the nodes of one segment share the force. Over a chord
/// (a particle wider than an element, docs/theory/contact.md): the overlap is what a flat surface would have at the
/// same common measure (surface/disc_overlap.hpp), and both the normal and the tangential force are spread over the
/// part of the surface in the particle. On a flat surface both are the same force on the particle, and the same
/// resultant.
#pragma once

#include <span>
#include <vector>

#include "contact/moving_surface.hpp"
#include "surface/disc_overlap.hpp"

namespace grainstep::contact {

struct Foot {
  surface::ClosestPoint at;  ///< over a chord: its normal, and the radius less the overlap for its distance
  double gain = 1.0;         ///< rate of the overlap over that of the approach along the normal
  double lever = 0.0;        ///< m, of a chord: from the particle's centre to the tangential force, along the normal
  double pressed = 0.0;      ///< m^3, size of the sum of the gradients
  double weight = 0.0;       ///< m^3, sum of the weights
  std::size_t first = 0, last = 0;  ///< shares of a chord; none: a point
  [[nodiscard]] bool is_point() const { return first == last; }
};

class Footing {
 public:
  void clear() { shares_.clear(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("shares of chords", shares_);
  }

  [[nodiscard]] static Foot at_point(const surface::ClosestPoint& closest) { return {.at = closest}; }

  /// `candidates`: at least the segments within `radius` of the centre. Valid until clear().
  [[nodiscard]] Foot over_chord(const MovingSurface& surface, const surface::Vec2& centre, double radius,
                                std::span<const std::uint32_t> candidates, const surface::ClosestPoint& closest);

  /// m/s: what the force on the particle, times this, does as work on it for the surface's motion.
  [[nodiscard]] surface::Vec2 velocity(const MovingSurface& surface, const Foot& foot) const;

  /// Adds an impulse on the surface (N s, in the plane) to its nodes.
  void give(const MovingSurface& surface, const Foot& foot, const surface::Vec2& impulse,
            std::span<surface::Vec2> nodal) const;

 private:
  [[nodiscard]] std::span<const surface::NodeShare> shares_of(const Foot& foot) const {
    return {shares_.data() + foot.first, foot.last - foot.first};
  }

  surface::DiscOverlapFinder finder_;
  std::vector<surface::NodeShare> shares_;
};

}  // namespace grainstep::contact
