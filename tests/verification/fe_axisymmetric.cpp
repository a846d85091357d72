// Patch tests of solids of revolution: hoop strain, the axis, motion along it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../support/fe_ring.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kSide = 1e-3;  // m, of a quad
constexpr double kRoundOff = 1e-12;

bool on_edge(const Body& body, const Nodes& nodes, std::size_t i) {
  const Mesh& mesh = body.mesh();
  const double margin = 1e-3 * mesh.width;
  return nodes.x0[i] < mesh.left + margin || nodes.x0[i] > mesh.left + mesh.length - margin || nodes.y0[i] > -margin ||
         nodes.y0[i] < mesh.level.back() + margin;
}

Body distorted_body(double inner) {
  Body body = test::ring_of(11, 8, kSide, inner);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.2 * kSide, 0.2 * kSide);
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const bool edge = on_edge(body, nodes, i);
    nodes.x[i] += edge ? 0.0 : shift(random);
    nodes.y[i] += edge ? 0.0 : shift(random);
  });
  return body;
}

double stress_error(const Body& body, const Stress& expected) {
  double worst = 0.0;
  test::for_each_triangle(body, [&](int row, int column, int triangle) {
    const Stress s = body.stress(row, column, triangle);
    for (const double error : {s.xx - expected.xx, s.yy - expected.yy, s.xy - expected.xy, s.zz - expected.zz}) {
      worst = verification::larger(worst, std::abs(error));
    }
  });
  return worst;
}

/// Largest force on a node inside, over that of `stress` on the side of its element's ring.
double force_error(const Body& body, double stress) {
  double worst = 0.0;
  for (const Nodes* nodes : {&body.corners, &body.centres}) {
    for (std::size_t i = 0; i < nodes->x.size(); ++i) {
      if (!(nodes->mass[i] > 0.0) || on_edge(body, *nodes, i)) continue;
      const double side = 2.0 * M_PI * nodes->x[i] * kSide;
      worst = verification::larger(worst, std::hypot(nodes->fx[i], nodes->fy[i]) / (stress * side));
    }
  }
  return worst;
}

class Patch : public testing::TestWithParam<double> {};

// u_r = c r, u_z = d z: one strain everywhere, the hoop's the same as the radial one.
TEST_P(Patch, UniformStrain) {
  constexpr double kStep = 1e-7, kRadial = 1e-2, kAxial = -2e-2;
  Body body = distorted_body(GetParam());
  test::head_for(body, kStep, [&](double x, double y) { return Vec2{x * (1.0 + kRadial), y * (1.0 + kAxial)}; });
  body.drift(kStep);
  body.sweep(kStep);
  const double radial = kRadial / (1.0 + 0.5 * kRadial);
  const double axial = kAxial / (1.0 + 0.5 * kAxial);
  const Stress expected = elastic_part(body.material(0)).increment({radial, axial, 0.0, radial});
  const std::string name = GetParam() > 0.0 ? "Patch test of a thick ring" : "Patch test of a disc, its axis included";
  const std::string reason = "exact: virtual power of a constant stress is integrated exactly";
  verification::check({.group = "structure",
                       .name = name,
                       .quantity = "stress, largest error of any triangle / von Mises stress",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "sigma = C : (c, d, c)/(1 + half of it), u_r = c r, u_z = d z",
                       .expected = 0.0,
                       .found = stress_error(body, expected) / von_mises(expected),
                       .tolerance = kRoundOff,
                       .reason = reason});
  verification::check({.group = "structure",
                       .name = name,
                       .quantity = "largest force inside / force on a side",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "d(r sigma_rr)/dr = sigma_hoop",
                       .expected = 0.0,
                       .found = force_error(body, von_mises(expected)),
                       .tolerance = kRoundOff,
                       .reason = reason});
}

TEST_P(Patch, TranslationAlongTheAxisIsFree) {
  constexpr double kStep = 1e-7, kSpeed = 100.0;
  Body body = distorted_body(GetParam());
  test::for_each_node(body, [](Nodes& nodes, std::size_t i) { nodes.v[i] = kSpeed; });
  for (int n = 0; n < 10; ++n) {
    body.drift(kStep);
    body.sweep(kStep);
  }
  verification::check(
      {.group = "structure",
       .name = GetParam() == 0.0 ? "Solid of revolution moved along its axis" : "Ring moved along its axis",
       .quantity = "largest stress / E",
       .unit = "",
       .reference = "closed form",
       .origin = "no strain",
       .expected = 0.0,
       .found = stress_error(body, {0.0, 0.0, 0.0, 0.0}) / 200e9,
       .tolerance = kRoundOff,
       .reason = "exact: round-off"});
  const double inner = GetParam();
  const double outer = inner + 11 * kSide;
  EXPECT_NEAR(body.mass() / (8000.0 * M_PI * (outer * outer - inner * inner) * 8 * kSide), 1.0, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Bodies, Patch, testing::Values(0.0, 5e-3));

}  // namespace
}  // namespace grainstep::fe
