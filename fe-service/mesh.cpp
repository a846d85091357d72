#include "fe-service/mesh.hpp"

#include <fmt/format.h>
#include <cmath>

#include "base/error.hpp"
#include "base/physical_memory.hpp"

namespace grainstep::fe {

namespace {

double wanted_size(const scene::Structure& structure) {
  const double first = structure.layers(0).thickness();
  const double reference = structure.layers_size() == 1 ? 0.5 * first : first;
  return reference / structure.mesh().refinement();
}

/// Elements that fill `length`, none larger than `size`. The margin keeps round-off from adding one.
double count(double length, double size) { return std::max(1.0, std::ceil(length / size - 1e-9)); }

void check_layer(const scene::Structure& structure, int layer, double size) {
  const double thickness = structure.layers(layer).thickness();
  if (size <= thickness * (1.0 + 1e-9)) return;
  throw InputError(fmt::format(
      "structure.mesh.refinement: mesh coarser than the face: {:g} gives elements of {:g} m, but structure.layers[{}] "
      "is "
      "only {:g} m thick; use a refinement of at least {:g}",
      structure.mesh().refinement(), size, layer, thickness, structure.mesh().refinement() * size / thickness));
}

void add_layer(Mesh& mesh, int layer, double thickness, double top) {
  const int rows = static_cast<int>(count(thickness, mesh.element_size));
  for (int r = 0; r < rows; ++r) {
    mesh.rows.push_back({layer, thickness / rows, mesh.width * thickness / rows});
    mesh.level.push_back(top - thickness * (r + 1) / rows);
  }
}

}  // namespace

void require_fits(double quads, const std::string& key) {
  constexpr double most = 1e8;
  constexpr double least_bytes = 8.0 * (2 * 10 + 4 * 4);  // two nodes' arrays, the stresses of four triangles
  if (!(quads < most)) throw InputError(key + "; lower it");
  if (quads * least_bytes <= physical_memory()) return;
  throw InputError(fmt::format("{}, which take more than {:.3g} GB; this machine has {:.3g} GB: lower it", key,
                               1e-9 * quads * least_bytes, 1e-9 * physical_memory()));
}

Mesh make_mesh(const scene::Structure& structure) {
  if (structure.layers().empty()) throw InputError("structure.layers: none given; a beam needs at least one");
  const double size = wanted_size(structure);
  double thickness = 0.0;
  double rows = 0.0;
  for (int layer = 0; layer < structure.layers_size(); ++layer) {
    check_layer(structure, layer, size);
    thickness += structure.layers(layer).thickness();
    rows += count(structure.layers(layer).thickness(), size);
  }
  const double half = structure.half_span();
  const double half_columns = count(half, size);
  const bool symmetric = structure.extent() != scene::Structure::EXTENT_FULL;
  require_fits(half_columns * rows * (symmetric ? 1.0 : 2.0),
               fmt::format("structure.mesh.refinement: {:g} gives {:g} x {:g} elements of {:g} m",
                           structure.mesh().refinement(), half_columns, rows, size));
  Mesh mesh{};
  mesh.symmetric = symmetric;
  mesh.element_size = size;
  mesh.left = symmetric ? 0.0 : -half;
  mesh.length = symmetric ? half : 2.0 * half;
  mesh.columns = static_cast<int>(half_columns) * (symmetric ? 1 : 2);
  mesh.mid_column = symmetric ? 0 : mesh.columns / 2;
  mesh.width = mesh.length / mesh.columns;
  mesh.level.push_back(0.0);
  double top = 0.0;
  for (int layer = 0; layer < structure.layers_size(); ++layer) {
    add_layer(mesh, layer, structure.layers(layer).thickness(), top);
    top -= structure.layers(layer).thickness();
  }
  return mesh;
}

std::vector<Corner> Mesh::surface() const {
  std::vector<Corner> chain;
  if (!symmetric) {
    for (int row = row_count(); row > 0; --row) chain.push_back({row, 0});
  }
  for (int column = 0; column <= columns; ++column) chain.push_back({0, column});
  for (int row = 1; row <= row_count(); ++row) chain.push_back({row, columns});
  return chain;
}

}  // namespace grainstep::fe
