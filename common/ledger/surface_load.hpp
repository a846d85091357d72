/// @file Contact pressure on the undeformed surface: (4.3) per facet and (4.4) for the whole.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "grainstep/wire.pb.h"

namespace grainstep::ledger {

/// The undeformed surface: segments, rings of a surface of revolution, or triangles. Each component of an impulse at a
/// node is shared among the facets that meet there in proportion to what a uniform pressure on them would give to the
/// node along it (its shape function over their area, as seen along the component), so that the facets' sum is the
/// nodes' sum, a uniform pressure is found again, and what presses on a face is not ascribed to the face around its
/// corner.
class SurfaceLoad {
 public:
  /// In two dimensions `depth` b in m, in three it is not read. Throws InputError where topology and positions do not
  /// fit or a facet has no extent.
  SurfaceLoad(const wire::Surface& surface, double depth);

  /// Of revolution about x1 = 0, impulses on the full rings. Throws as above, and where a segment lies on the axis.
  static SurfaceLoad of_revolution(const wire::Surface& surface);

  [[nodiscard]] std::size_t dimension() const { return dimension_; }
  [[nodiscard]] std::size_t nodes() const { return nodes_; }
  [[nodiscard]] std::size_t values() const { return dimension_ * nodes_; }  ///< of an impulse: nodes x dimension
  [[nodiscard]] std::size_t facets() const { return facets_.size(); }
  [[nodiscard]] std::vector<double> midpoints() const;  ///< m, undeformed x1 of every facet's middle
  [[nodiscard]] std::vector<double> middles() const;    ///< m, undeformed, facets x dimension
  [[nodiscard]] std::vector<double> lengths() const;    ///< m, undeformed, of segments
  [[nodiscard]] std::vector<double> areas() const;      ///< m^2, undeformed
  [[nodiscard]] double area_of_face() const;            ///< m^2, of all facets of the loaded face

  /// Normal impulse over undeformed area of every facet, Pa s, positive where the structure is pressed.
  /// `impulse`: nodes x dimension, N s.
  [[nodiscard]] std::vector<double> impulse_per_area(std::span<const double> impulse) const;

  /// What presses on the loaded face, N s: the impulse along -x2 over the facets whose undeformed outward normal
  /// points to the side of +x2. What touches the end faces around its corners, and friction along it, is none of it:
  /// where nothing else is touched this is what the momentum ledger calls the interface's.
  [[nodiscard]] double impulse_on_face(std::span<const double> impulse) const;

 private:
  static constexpr int most = 3;  // dimensions
  struct Facet {
    std::size_t node[most];
    double share[most][most];  // part of each node's impulse, by component
    double normal[most];       // outward
    double middle[most];
    double length;
    double area;          // m^2
    double weight[most];  // in proportion to the integral of each node's shape function over the area
    [[nodiscard]] double seen_along(int axis, int k) const { return weight[k] * std::abs(normal[axis]); }
    [[nodiscard]] bool of_loaded_face() const { return normal[1] > round_off; }
  };
  static constexpr double round_off = 1e-9;  // of the normal of an end face that is not quite upright
  enum class Shape { extruded, revolved };
  SurfaceLoad(const wire::Surface& surface, Shape shape, double depth);
  static void measure_segment(Facet& facet, const double (&radius)[2], Shape shape, double depth);
  [[nodiscard]] Facet segment(const wire::Surface& surface, int first, Shape shape, double depth) const;
  [[nodiscard]] Facet triangle(const wire::Surface& surface, int first) const;
  [[nodiscard]] Facet named(const wire::Surface& surface, int first) const;
  [[nodiscard]] double pressed(const Facet& facet, std::span<const double> impulse) const;

  std::size_t dimension_;
  std::size_t nodes_;
  std::vector<Facet> facets_;
};

}  // namespace grainstep::ledger
