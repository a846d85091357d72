/// @file Contact pressure on the undeformed surface: (4.3) per segment and (4.4) for the whole.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "grainstep/wire.pb.h"

namespace grainstep::ledger {

/// The undeformed surface in two dimensions: segments, or rings of a surface of revolution. Each component of an
/// impulse at a node is shared among the segments that meet there in proportion to what a uniform pressure on them
/// would give to the node along it (its shape function over their area, as seen along the component), so that the
/// segments' sum is the nodes' sum, a uniform pressure is found again, and what presses on a face is not ascribed to
/// the face around its corner.
class SurfaceLoad {
 public:
  /// `depth` b in m. Throws InputError where topology and positions do not fit or a segment has no length.
  SurfaceLoad(const wire::Surface& surface, double depth);

  /// Of revolution about x1 = 0, impulses on the full rings. Throws as above, and where a segment lies on the axis.
  static SurfaceLoad of_revolution(const wire::Surface& surface);

  [[nodiscard]] std::size_t nodes() const { return nodes_; }
  [[nodiscard]] std::size_t segments() const { return segments_.size(); }
  [[nodiscard]] std::vector<double> midpoints() const;  ///< m, undeformed x1 of every segment's middle
  [[nodiscard]] std::vector<double> lengths() const;    ///< m, undeformed

  /// Normal impulse over undeformed area of every segment, Pa s, positive where the structure is pressed.
  /// `impulse`: nodes x 2, N s.
  [[nodiscard]] std::vector<double> impulse_per_area(std::span<const double> impulse) const;

  /// What presses on the loaded face, N s: the impulse along -x2 over the segments whose undeformed outward normal
  /// points to the side of +x2. What touches the end faces around its corners, and friction along it, is none of it:
  /// where nothing else is touched this is what the momentum ledger calls the interface's.
  [[nodiscard]] double impulse_on_face(std::span<const double> impulse) const;

 private:
  struct Segment {
    std::size_t node[2];
    double share[2][2];  // part of each node's impulse, by component
    double normal[2];    // outward
    double middle;
    double length;
    double area;       // m^2
    double weight[2];  // in proportion to the integral of each node's shape function over the area
    [[nodiscard]] double seen_along(int axis, int k) const { return weight[k] * std::abs(normal[axis]); }
    [[nodiscard]] bool of_loaded_face() const { return normal[1] > round_off; }
  };
  static constexpr double round_off = 1e-9;  // of the normal of an end face that is not quite upright
  enum class Shape { extruded, revolved };
  SurfaceLoad(const wire::Surface& surface, Shape shape, double depth);
  static void measure(Segment& segment, const double (&radius)[2], Shape shape, double depth);
  [[nodiscard]] static double pressed(const Segment& segment, std::span<const double> impulse);

  std::size_t nodes_;
  std::vector<Segment> segments_;
};

}  // namespace grainstep::ledger
