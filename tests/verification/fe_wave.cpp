// A velocity step in a bar that cannot strain sideways splits into two waves of speed c = sqrt((lambda + 2 mu)/rho),
// with stress -rho c V/2 and velocity V/2 between them.
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "fe-service/layers.hpp"

namespace grainstep::fe {
namespace {

constexpr double kLength = 0.4;
constexpr double kSpeed = 1.0;

TEST(FeWave, SpeedAndAmplitudeOfAVelocityStep) {
  const scene::Structure structure = test::beam(scene::Layer::MATERIAL_ELASTIC, kLength, 4e-3, 2);
  Body body(make_mesh(structure), make_layers(structure), 1e-3);
  const Elastic& law = elastic_part(body.material(0));
  const double c = std::sqrt(law.longitudinal_modulus() / law.density);
  const double step = 0.9 * body.stable_step();
  // A ramp of eight elements keeps the oscillations of the mesh behind the front small.
  const auto initial = [](double x) { return kSpeed * std::clamp(0.5 - (x - 0.5 * kLength) / 16e-3, 0.0, 1.0); };
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) { nodes.u[i] = initial(nodes.x0[i]); });
  const int steps = static_cast<int>(0.1 / c / step);  // fronts travel 0.1 m: a quarter of the bar
  for (int n = 0; n < steps; ++n) {
    body.kick(n == 0 ? 0.0 : step);
    test::for_each_node(body, [](Nodes& nodes, std::size_t i) { nodes.v[i] = 0.0; });
    body.drift(step);
    body.sweep(step);
  }
  double stress = 0.0;
  int count = 0;
  double front = 0.0;
  for (int column = 0; column < body.mesh().columns; ++column) {
    const double x = body.mesh().corner_x(column);
    if (std::abs(x - 0.5 * kLength) < 0.05) {
      stress += body.stress(1, column, 0).xx;
      ++count;
    }
    if (body.corners.u[body.mesh().corner({1, column})] > 0.25 * kSpeed) front = x;
  }
  // Discretisation: mean over the plateau, ripples of the mesh left; front within an element.
  EXPECT_NEAR(stress / count, -0.5 * law.density * c * kSpeed, 2e-3 * 0.5 * law.density * c * kSpeed);
  EXPECT_NEAR(front - 0.5 * kLength, c * step * steps, 2.0 * body.mesh().width);
}

}  // namespace
}  // namespace grainstep::fe
