#include "fe-service/solid.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace grainstep::fe {

Measure make_measure(scene::Symmetry symmetry, double depth) {
  switch (symmetry) {
    case scene::SYMMETRY_PLANE_STRAIN:
      if (!(depth > 0.0) || !std::isfinite(depth))
        throw InputError(fmt::format("depth: found {:g} m, expected a length above 0", depth));
      return PlaneStrain{depth};
    case scene::SYMMETRY_AXISYMMETRIC:
      return Axisymmetric{};
    default:
      throw InputError(
          fmt::format("symmetry: grainstep-fe knows `plane_strain` and `axisymmetric`, found value number {}",
                      static_cast<int>(symmetry)));
  }
}

void check_measure(const scene::Structure& structure, const Measure& measure) {
  const bool ring = is_of_revolution(measure);
  if (ring && structure.type() == scene::Structure::TYPE_BEAM)
    throw InputError("structure.type: a beam is not a solid of revolution; with symmetry: axisymmetric take plate");
  if (!ring && structure.type() == scene::Structure::TYPE_PLATE)
    throw InputError("symmetry: a circular plate needs axisymmetric");
  if (ring && structure.extent() == scene::Structure::EXTENT_FULL)
    throw InputError("structure.extent: half is the whole of a solid of revolution (0 <= r <= R), found full");
}

}  // namespace grainstep::fe
