// The first frequency of a clamped beam in plane strain converges with the mesh, to that of a Timoshenko beam with the
// plane-strain modulus E/(1 - nu^2).
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "fe-service/layers.hpp"

namespace grainstep::fe {
namespace {

constexpr double kHalfSpan = 0.5;
constexpr double kThickness = 0.04;

/// Period of the first mode from half of it: mid-span starts at rest with a velocity and returns to where it was.
double period(int elements_through_thickness) {
  const scene::Structure structure =
      test::beam(scene::Layer::MATERIAL_ELASTIC, kHalfSpan, kThickness, 0.5 * elements_through_thickness);
  Body body(make_mesh(structure), make_layers(structure), 1e-3);
  const double step = 0.9 * body.stable_step();
  // Close to the first mode; what others it holds is filtered by comparing whole-body momentum, not one point.
  test::for_each_node(body, [](Nodes& nodes, std::size_t i) {
    const double s = 1.0 - (nodes.x0[i] / kHalfSpan) * (nodes.x0[i] / kHalfSpan);
    nodes.v[i] = -1e-2 * s * s;
  });
  // The projection of the displacement on that shape, weighted by mass: other modes nearly vanish in it.
  const auto projection = [&body] {
    double sum = 0.0;
    test::for_each_node(body, [&sum](const Nodes& nodes, std::size_t i) {
      const double s = 1.0 - (nodes.x0[i] / kHalfSpan) * (nodes.x0[i] / kHalfSpan);
      sum += nodes.mass[i] * s * s * (nodes.y0[i] - nodes.y[i]);
    });
    return sum;
  };
  double before = 0.0;
  for (int n = 0; n < 10'000'000; ++n) {
    body.kick(n == 0 ? 0.5 * step : step);
    (void)body.hold_supports();
    body.drift(step);
    body.sweep(step);
    if (n % 16 != 0) continue;
    const double now = projection();
    if (n > 0 && now <= 0.0) return 2.0 * step * (n + 1 - 16.0 * now / (now - before));
    before = now;
  }
  ADD_FAILURE() << "does not return";
  return 0.0;
}

/// Circular frequency of the first symmetric mode of a clamped Timoshenko beam (shear factor 5/6).
double timoshenko() {
  const double modulus = 200e9 / (1.0 - 0.3 * 0.3);
  const double shear = 200e9 / 2.6 * kThickness * 5.0 / 6.0;
  const double inertia = std::pow(kThickness, 3) / 12.0;
  const auto determinant = [&](double omega) {
    Eigen::Matrix4d system = Eigen::Matrix4d::Zero();  // of (w, phi, M, Q), per unit depth
    system(0, 1) = 1.0;
    system(0, 3) = 1.0 / shear;
    system(1, 2) = 1.0 / (modulus * inertia);
    system(2, 1) = -8000.0 * inertia * omega * omega;
    system(2, 3) = -1.0;
    system(3, 0) = -8000.0 * kThickness * omega * omega;
    const Eigen::Matrix4d transfer = (kHalfSpan * system).exp();
    // Mid-span: phi = Q = 0; clamp: w = phi = 0.
    return transfer(0, 0) * transfer(1, 2) - transfer(0, 2) * transfer(1, 0);
  };
  const double euler = 22.3733 * std::sqrt(modulus * inertia / (8000.0 * kThickness)) / std::pow(2.0 * kHalfSpan, 2);
  double low = 0.8 * euler;
  double high = euler;
  const bool sign = determinant(low) > 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((determinant(middle) > 0.0) == sign ? low : high) = middle;
  }
  return low;
}

TEST(FeBeam, FirstFrequencyConvergesToTimoshenkoInSecondOrder) {
  const double frequency[] = {2.0 * M_PI / period(2), 2.0 * M_PI / period(4), 2.0 * M_PI / period(8)};
  const double order = std::log2((frequency[0] - frequency[1]) / (frequency[1] - frequency[2]));
  const double limit = frequency[2] - (frequency[1] - frequency[2]) / 3.0;
  EXPECT_NEAR(order, 2.0, 0.2) << frequency[0] << " " << frequency[1] << " " << frequency[2];
  // Model: a beam theory of a body with a thickness of 1/25 of its span.
  EXPECT_NEAR(limit, timoshenko(), 5e-3 * timoshenko());
}

}  // namespace
}  // namespace grainstep::fe
