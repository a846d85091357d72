// Patch test and rigid rotation: what the elements must do exactly, on a distorted mesh.
#include <gtest/gtest.h>

#include <random>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "fe-service/layers.hpp"

namespace grainstep::fe {
namespace {

constexpr double kStep = 1e-7;

/// Interior nodes are displaced at random by up to a fifth of an element.
Body distorted_body() {
  const scene::Structure structure = test::beam(scene::Layer::MATERIAL_ELASTIC, 11e-3, 8e-3, 4);
  Body body(make_mesh(structure), make_layers(structure), 1e-3);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.2e-3, 0.2e-3);
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const bool edge =
        nodes.x0[i] < 1e-6 || nodes.x0[i] > 11e-3 - 1e-6 || nodes.y0[i] > -1e-6 || nodes.y0[i] < -8e-3 + 1e-6;
    nodes.x[i] += edge ? 0.0 : shift(random);
    nodes.y[i] += edge ? 0.0 : shift(random);
  });
  return body;
}

/// Strains of 2%: positions are rounded to 1e-16 of the body, 1e-15 of an element, and so strains by 1e-13 of
/// themselves.
void deform(Body& body) {
  test::head_for(body, kStep, [](double x, double y) {
    return Vec2{x + 2e-2 * x - 1e-2 * y, y + 5e-3 * x - 1.5e-2 * y};
  });
  body.drift(kStep);
  body.sweep(kStep);
}

TEST(FePatch, LinearMotionGivesUniformStressAndNoForceInside) {
  Body body = distorted_body();
  deform(body);
  const Stress expected = body.stress(0, 0, 0);
  const double scale = von_mises(expected);
  test::for_each_triangle(body, [&](int row, int column, int triangle) {
    const Stress s = body.stress(row, column, triangle);
    EXPECT_NEAR(s.xx, expected.xx, 1e-12 * scale);
    EXPECT_NEAR(s.yy, expected.yy, 1e-12 * scale);
    EXPECT_NEAR(s.xy, expected.xy, 1e-12 * scale);
    EXPECT_NEAR(s.zz, expected.zz, 1e-12 * scale);
  });
  const double force = scale * 1e-3 * 1e-3;  // on an element's side
  for (int row = 1; row < body.mesh().row_count(); ++row) {
    for (int column = 1; column < body.mesh().columns; ++column) {
      const std::size_t i = body.mesh().corner({row, column});
      EXPECT_NEAR(body.corners.fx[i], 0.0, 1e-12 * force);
      EXPECT_NEAR(body.corners.fy[i], 0.0, 1e-12 * force);
    }
  }
}

TEST(FePatch, UniformStressIsTheClosedForm) {
  Body body = distorted_body();
  deform(body);
  // Gradient at the middle of the step: L (I + L/2)^-1.
  const double a = 2e-2, b = -1e-2, c = 5e-3, d = -1.5e-2;
  const double det = (1.0 + 0.5 * a) * (1.0 + 0.5 * d) - 0.25 * b * c;
  const double xx = (a * (1.0 + 0.5 * d) - 0.5 * b * c) / det;
  const double xy = (-0.5 * a * b + b * (1.0 + 0.5 * a)) / det;
  const double yx = (c * (1.0 + 0.5 * d) - 0.5 * d * c) / det;
  const double yy = (-0.5 * c * b + d * (1.0 + 0.5 * a)) / det;
  const Stress expected = elastic_part(body.material(0)).increment({xx, yy, xy + yx, 0.0});
  const Stress found = body.stress(3, 4, 2);
  EXPECT_NEAR(found.xx, expected.xx, 1e-12 * std::abs(expected.xx));
  EXPECT_NEAR(found.yy, expected.yy, 1e-12 * std::abs(expected.xx));
  EXPECT_NEAR(found.xy, expected.xy, 1e-12 * std::abs(expected.xx));
  EXPECT_NEAR(found.zz, expected.zz, 1e-12 * std::abs(expected.xx));
}

TEST(FePatch, TwentyTurnsTurnTheStressAndNothingElse) {
  Body body = distorted_body();
  deform(body);
  const Stress before = body.stress(3, 4, 2);
  const double energy = elastic_energy(body);
  constexpr int kSteps = 2000;
  const double angle = 20.0 * 2.0 * M_PI / kSteps;
  for (int n = 0; n < kSteps; ++n) {
    test::head_for(body, kStep, [angle](double x, double y) {
      return Vec2{std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y};
    });
    body.drift(kStep);
    body.sweep(kStep);
  }
  const Stress after = body.stress(3, 4, 2);
  // Exact, but for the positions' round-off: the body is 14 elements across, so each step strains by 14 x 2.2e-16, at
  // random.
  const double tolerance = 14.0 * 2.2e-16 * std::sqrt(kSteps) * elastic_part(body.material(0)).longitudinal_modulus();
  EXPECT_NEAR(after.xx, before.xx, tolerance);
  EXPECT_NEAR(after.yy, before.yy, tolerance);
  EXPECT_NEAR(after.xy, before.xy, tolerance);
  EXPECT_NEAR(elastic_energy(body), energy, 1e-11 * energy);
}

TEST(FePatch, QuarterTurnSwapsTheComponents) {
  Body body = distorted_body();
  deform(body);
  const Stress before = body.stress(3, 4, 2);
  test::head_for(body, kStep, [](double x, double y) { return Vec2{-y, x}; });
  body.drift(kStep);
  body.sweep(kStep);
  const Stress after = body.stress(3, 4, 2);
  const double tolerance = 1e-12 * von_mises(before);
  EXPECT_NEAR(after.xx, before.yy, tolerance);
  EXPECT_NEAR(after.yy, before.xx, tolerance);
  EXPECT_NEAR(after.xy, -before.xy, tolerance);
}

}  // namespace
}  // namespace grainstep::fe
