/// @file Elastic bodies of revolution for tests.
#pragma once

#include "fe_motion.hpp"
#include "fe_scenes.hpp"

namespace grainstep::fe::test {

/// Steel, `columns` x `rows` quads of `side` m; `inner`: m, radius of the hole.
[[nodiscard]] inline Body ring_of(int columns, int rows, double side, double inner) {
  const double refinement = 0.5 * rows;
  Mesh mesh = make_mesh(beam(scene::Layer::MATERIAL_ELASTIC, columns * side, rows * side, refinement));
  mesh.left = inner;
  return {mesh, {Elastic::from_young(200e9, 0.3, 8000.0)}, Axisymmetric{}};
}

}  // namespace grainstep::fe::test
