/// @file Which parts of the surface's segments a pressure acts on, and what it gives to their nodes.
#pragma once

#include <span>
#include <vector>

#include "fe-service/measure.hpp"
#include "fe-service/triangle.hpp"
#include "grainstep/wire.pb.h"

namespace grainstep::fe {

/// Parts of segments, fixed in the undeformed configuration: the pressure stays on the material that it began on.
class LoadedPatch {
 public:
  /// All of the loaded face (what has its undeformed normal within 45 degrees of x2), or what of it lies within
  /// `patch`.
  LoadedPatch(const wire::Surface& surface, const scene::Pressure& pressure);

  /// m, undeformed, along x1.
  [[nodiscard]] double width() const;

  /// Adds the impulse of `impulse` (Pa s) on the surface at `position` (m, nodes x 2) to `nodal` (N s, nodes x 2). It
  /// acts against the current outward normal, on the current area: length times the depth b, or the rings. With the
  /// linear shape functions of a segment, the uniform load on a part of it goes to its two nodes as its resultant does,
  /// which stands in the part's middle, or beyond it where rings grow: force and moment are exact, on deformed segments
  /// as well, and so is the work against the volume that the surface sweeps.
  void press(double impulse, const Measure& measure, std::span<const double> position, std::span<double> nodal) const;

 private:
  struct Part {
    std::uint32_t first, second;  ///< nodes
    double share;                 ///< of the segment's length
    double middle;                ///< 0 at the first node, 1 at the second
    double width;                 ///< m, undeformed
  };
  std::vector<Part> parts_;
};

}  // namespace grainstep::fe
