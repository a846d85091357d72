// Cylinders and discs against closed forms: a bore under pressure, breathing, a plane wave along the axis.
#include <gtest/gtest.h>

#include <cmath>

#include "../support/fe_mode.hpp"
#include "../support/fe_ring.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

/// A result over the closed form's on two meshes: the finer one's difference, and how it falls.
struct Refined {
  std::string name, quantity, origin;
  double coarse, fine;  ///< 10 and 20 quads
  double tolerance, order_tolerance;
  std::string order_reason;
};

void check(const Refined& result) {
  verification::Comparison comparison{.group = "structure",
                                      .name = result.name,
                                      .quantity = result.quantity + ", 20 quads",
                                      .unit = "",
                                      .reference = "closed form",
                                      .origin = result.origin,
                                      .expected = 1.0,
                                      .found = result.fine,
                                      .tolerance = result.tolerance,
                                      .reason = "discretisation: second order"};
  verification::check(comparison);
  comparison.quantity = "order in the mesh, 10 and 20 quads";
  comparison.origin = "constant-strain triangles: energies converge with h^2";
  comparison.expected = 2.0;
  comparison.found = std::log2(std::abs(1.0 - result.coarse) / std::abs(1.0 - result.fine));
  comparison.tolerance = result.order_tolerance;
  comparison.reason = result.order_reason;
  verification::check(comparison);
}

/// Displacement of the bore of a thick cylinder under inner pressure, no strain along z, over Lame's.
double bore(int columns) {
  const double inner = 10e-3, outer = 20e-3, pressure = 1e6;
  const double side = (outer - inner) / columns;
  Body body = test::ring_of(columns, 1, side, inner);
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
  check({"Thick cylinder under inner pressure", "displacement of the bore over Lame's",
         "u = p a^2/(b^2 - a^2) [r/(2 (lambda + mu)) + b^2/(2 mu r)], b = 2 a", bore(10), bore(20), 1e-3, 0.1,
         "discretisation: asymptotic range"});
}

/// k R of the first breathing mode of a cylinder without strain along z: sigma_rr = 0 at R for u = J_1(k r).
double breathing_root() {
  const double ratio = (1.0 - 2.0 * 0.3) / (1.0 - 0.3);
  const auto boundary = [&](double z) { return z * std::cyl_bessel_j(0.0, z) - ratio * std::cyl_bessel_j(1.0, z); };
  double low = 1.0, high = 2.4;
  for (int i = 0; i < 60; ++i) (boundary(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  return low;
}

/// Circular frequency over the closed form's.
double breathing(int columns) {
  const double outer = 20e-3;
  const double root = breathing_root();
  Body body = test::ring_of(columns, 1, outer / columns, 0.0);
  const Elastic& law = elastic_part(body.material(0));
  const double omega = root / outer * std::sqrt(law.longitudinal_modulus() / law.density);
  const auto velocity = [&](const Nodes& nodes, std::size_t i) {
    return Vec2{std::cyl_bessel_j(1.0, root * nodes.x0[i] / outer), 0.0};
  };
  const auto hold = [](Body& b) {
    for (int row = 0; row <= 1; ++row) b.corners.u[b.mesh().corner({row, 0})] = 0.0;
    test::for_each_node(b, [](Nodes& nodes, std::size_t i) { nodes.v[i] = 0.0; });
  };
  return test::frequency_of_mode(body, omega, 0.45, velocity, hold) / omega;
}

TEST(FeAxisymmetric, BreathingOfACylinder) {
  check({"Breathing of a solid cylinder", "frequency over the closed form's",
         "k R J_0(k R) = (1 - 2 nu)/(1 - nu) J_1(k R), omega = k c_P", breathing(10), breathing(20), 2e-3, 0.25,
         "discretisation: lumped ring masses near the axis"});
}

/// Largest difference of the velocity along z at the axis from that at half the radius, over p/(rho c): a P wave that a
/// uniform pressure, rising over ten quads, sends into a disc whose radius is held. Plane waves know no radius.
double unevenness(int columns) {
  const double side = 10e-3 / columns;
  Body body = test::ring_of(columns, 2 * columns, side, 0.0);
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
    worst = verification::larger(worst, std::abs(difference) * law.density * c / pressure);
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
