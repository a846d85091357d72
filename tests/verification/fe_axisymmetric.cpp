// Solids of revolution against closed forms: patch tests with hoop strain, a thick cylinder under pressure, the
// breathing of a cylinder, a uniform pressure on a disc.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kSide = 1e-3;  // m, of a quad
constexpr double kRoundOff = 1e-12;

/// `columns` x `rows` quads; `inner`: radius of a hole.
Body body_of(int columns, int rows, double side, double inner) {
  const double refinement = 0.5 * rows;
  Mesh mesh = make_mesh(test::beam(scene::Layer::MATERIAL_ELASTIC, columns * side, rows * side, refinement));
  mesh.left = inner;
  return {mesh, {Elastic::from_young(200e9, 0.3, 8000.0)}, Axisymmetric{}};
}

bool on_edge(const Body& body, const Nodes& nodes, std::size_t i) {
  const Mesh& mesh = body.mesh();
  const double margin = 1e-3 * mesh.width;
  return nodes.x0[i] < mesh.left + margin || nodes.x0[i] > mesh.left + mesh.length - margin || nodes.y0[i] > -margin ||
         nodes.y0[i] < mesh.level.back() + margin;
}

Body distorted_body(double inner) {
  Body body = body_of(11, 8, kSide, inner);
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
      worst = std::max(worst, std::abs(error));
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
      worst = std::max(worst, std::hypot(nodes->fx[i], nodes->fy[i]) / (stress * side));
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

/// Displacement of the bore of a thick cylinder under inner pressure, no strain along z, over Lame's.
double bore(int columns) {
  const double inner = 10e-3, outer = 20e-3, pressure = 1e6;
  const double side = (outer - inner) / columns;
  Body body = body_of(columns, 1, side, inner);
  test::Stepper stepper(body, 0.9 * body.stable_step());
  const double damping = 2.0 * 5000.0 / outer;  // 1/s, about critical for breathing
  for (int n = 0; n < 60 * columns; ++n) {
    stepper([&](Body& b) {
      for (int row = 0; row <= 1; ++row) {
        const std::size_t i = b.mesh().corner({row, 0});
        const double weight = n == 0 ? 0.5 : 1.0;
        b.corners.u[i] += weight * stepper.step() * pressure * M_PI * inner * side * b.corners.inverse_mass[i];
      }
      test::for_each_node(b, [&](Nodes& nodes, std::size_t i) {
        nodes.u[i] *= 1.0 - damping * stepper.step();
        nodes.v[i] = 0.0;
      });
    });
  }
  const Elastic& law = elastic_part(body.material(0));
  const double k = pressure * inner * inner / (outer * outer - inner * inner);
  const double lame = k * inner / (2.0 * (law.lambda + law.mu)) + k * outer * outer / (2.0 * law.mu * inner);
  const std::size_t i = body.mesh().corner({0, 0});
  return (body.corners.x[i] - body.corners.x0[i]) / lame;
}

TEST(FeAxisymmetric, ThickCylinderUnderPressure) {
  const double coarse = bore(10), fine = bore(20);
  const std::string name = "Thick cylinder under inner pressure";
  verification::check({.group = "structure",
                       .name = name,
                       .quantity = "displacement of the bore over Lame's, 20 quads",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "u = p a^2/(b^2 - a^2) [r/(2 (lambda + mu)) + b^2/(2 mu r)], b = 2 a",
                       .expected = 1.0,
                       .found = fine,
                       .tolerance = 1e-3,
                       .reason = "discretisation: second order"});
  verification::check({.group = "structure",
                       .name = name,
                       .quantity = "order in the mesh, 10 and 20 quads",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "constant-strain triangles: energies converge with h^2",
                       .expected = 2.0,
                       .found = std::log2((1.0 - coarse) / (1.0 - fine)),
                       .tolerance = 0.1,
                       .reason = "discretisation: asymptotic range"});
}

/// k R of the first breathing mode of a cylinder without strain along z: sigma_rr = 0 at R for u = J_1(k r).
double breathing_root() {
  const double ratio = (1.0 - 2.0 * 0.3) / (1.0 - 0.3);
  const auto boundary = [&](double z) { return z * std::cyl_bessel_j(0.0, z) - ratio * std::cyl_bessel_j(1.0, z); };
  double low = 1.0, high = 2.4;
  for (int i = 0; i < 60; ++i) (boundary(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  return low;
}

/// Circular frequency over the closed form's, from half a period.
double breathing(int columns) {
  const double outer = 20e-3;
  const double root = breathing_root();
  Body body = body_of(columns, 1, outer / columns, 0.0);
  const auto shape = [&](const Nodes& nodes, std::size_t i) {
    return std::cyl_bessel_j(1.0, root * nodes.x0[i] / outer);
  };
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) { nodes.u[i] = 1e-3 * shape(nodes, i); });
  const auto projection = [&] {
    double sum = 0.0;
    test::for_each_node(body, [&](const Nodes& nodes, std::size_t i) {
      sum += nodes.mass[i] * (nodes.x[i] - nodes.x0[i]) * shape(nodes, i);
    });
    return sum;
  };
  const Elastic& law = elastic_part(body.material(0));
  const double omega = root / outer * std::sqrt(law.longitudinal_modulus() / law.density);
  test::Stepper stepper(body, 0.45 * body.stable_step());
  double before = 0.0, time_before = 0.0;
  while (stepper.time() < 2.0 * M_PI / omega) {
    stepper([](Body& b) {
      for (int row = 0; row <= 1; ++row) b.corners.u[b.mesh().corner({row, 0})] = 0.0;
      test::for_each_node(b, [](Nodes& nodes, std::size_t i) { nodes.v[i] = 0.0; });
    });
    const double now = projection();
    if (stepper.time() > 0.5 * M_PI / omega && now <= 0.0) {
      return M_PI / (time_before + (stepper.time() - time_before) * before / (before - now)) / omega;
    }
    before = now;
    time_before = stepper.time();
  }
  ADD_FAILURE() << "does not return";
  return 0.0;
}

TEST(FeAxisymmetric, BreathingOfACylinder) {
  const double coarse = breathing(10), fine = breathing(20);
  const std::string name = "Breathing of a solid cylinder";
  verification::check({.group = "structure",
                       .name = name,
                       .quantity = "frequency over the closed form's, 20 quads",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "k R J_0(k R) = (1 - 2 nu)/(1 - nu) J_1(k R), omega = k c_P",
                       .expected = 1.0,
                       .found = fine,
                       .tolerance = 2e-3,
                       .reason = "discretisation: second order"});
  verification::check({.group = "structure",
                       .name = name,
                       .quantity = "order in the mesh, 10 and 20 quads",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "constant-strain triangles: energies converge with h^2",
                       .expected = 2.0,
                       .found = std::log2(std::abs(1.0 - coarse) / std::abs(1.0 - fine)),
                       .tolerance = 0.25,
                       .reason = "discretisation: lumped ring masses near the axis"});
}

/// Largest difference of the velocity along z at the axis from that at half the radius, over p/(rho c): a P wave that a
/// uniform pressure, rising over ten quads, sends into a disc whose radius is held. Plane waves know no radius.
double unevenness(int columns) {
  const double side = 10e-3 / columns;
  Body body = body_of(columns, 2 * columns, side, 0.0);
  const Mesh& mesh = body.mesh();
  const Elastic& law = elastic_part(body.material(0));
  const double c = std::sqrt(law.longitudinal_modulus() / law.density);
  const double pressure = 1e6, rise = 10e-3 / c;
  test::Stepper stepper(body, 0.9 * body.stable_step());
  while (stepper.time() < 16e-3 / c) {
    const double t = stepper.time();
    const double now = pressure * (t < rise ? 0.5 - 0.5 * std::cos(M_PI * t / rise) : 1.0);
    stepper([&](Body& b) {
      for (int column = 0; column < mesh.columns; ++column) {
        const double r[] = {mesh.corner_x(column), mesh.corner_x(column + 1)};
        for (int k = 0; k < 2; ++k) {
          const std::size_t i = mesh.corner({0, column + k});
          const double force = now * M_PI / 3.0 * side * (2.0 * r[k] + r[1 - k]);
          b.corners.v[i] -= stepper.step() * force * b.corners.inverse_mass[i];
        }
      }
      test::for_each_node(b, [](Nodes& nodes, std::size_t i) { nodes.u[i] = 0.0; });
    });
  }
  double worst = 0.0;
  for (int row = 0; row <= mesh.row_count() / 2; ++row) {
    const double difference =
        body.corners.v[mesh.corner({row, 0})] - body.corners.v[mesh.corner({row, mesh.columns / 2})];
    worst = std::max(worst, std::abs(difference) * law.density * c / pressure);
  }
  return worst;
}

TEST(FeAxisymmetric, PlaneWaveAtTheAxis) {
  const double coarse = unevenness(10), fine = unevenness(20);
  verification::check({.group = "structure",
                       .name = "Plane wave along the axis of a disc",
                       .quantity = "velocity at the axis - at half the radius, over p/(rho c), front of 20 quads",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "d'Alembert: the wave does not depend on r",
                       .expected = 0.0,
                       .found = fine,
                       .tolerance = 0.01,
                       .reason = "discretisation: a rise over 20 quads; falls with its steepness"});
  EXPECT_LT(fine, 0.5 * coarse);
}

}  // namespace
}  // namespace grainstep::fe
