/// @file A small block of one material that is moved by hand, and the stress that all of it should have.
#pragma once

#include <gtest/gtest.h>

#include "fe_motion.hpp"
#include "fe_scenes.hpp"

namespace grainstep::fe::test {

constexpr double block_width = 9e-3;   // m
constexpr double block_height = 4e-3;  // m, two quads

[[nodiscard]] inline Body block_of(const Material& law, const Kernels& kernels = *available_kernels().front()) {
  const scene::Structure structure = beam(scene::Layer::MATERIAL_ELASTIC, block_width, block_height, 2);
  return {make_mesh(structure), {law}, PlaneStrain{1e-3}, kernels};
}

/// In every triangle, within `tolerance` (Pa).
inline void expect_stress(const Body& body, const Stress& expected, double tolerance) {
  for_each_triangle(body, [&](int row, int column, int triangle) {
    const Stress found = body.stress(row, column, triangle);
    EXPECT_NEAR(found.xx, expected.xx, tolerance);
    EXPECT_NEAR(found.yy, expected.yy, tolerance);
    EXPECT_NEAR(found.xy, expected.xy, tolerance);
    EXPECT_NEAR(found.zz, expected.zz, tolerance);
  });
}

/// The plastic strain that the body keeps, in every triangle.
inline void expect_plastic_strain(const Body& body, double expected, double tolerance) {
  for_each_triangle(body, [&](int row, int column, int triangle) {
    EXPECT_NEAR(body.plastic_strain(row, column, triangle), expected, tolerance);
  });
}

}  // namespace grainstep::fe::test
