// Plane waves along a bar: a pulse of velocity at rest splits into two of half its height, of speed c and stress rho c
// v. P waves: no motion across, c^2 = (lambda + 2 mu)/rho; S waves: no motion along, c^2 = mu/rho.
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kLength = 0.4;
constexpr double kSpeed = 1e-2;   ///< small: waves of finite strain run at another speed, by about the strain
constexpr double kWidth = 10e-3;  ///< of the pulse
constexpr double kPath = 0.1;     ///< that it travels

enum class Wave { kP, kS };

struct WaveResult {
  double error = 0.0;   ///< of velocity, root of mean squares over mass, over that of the pulse
  double speed = 0.0;   ///< m/s, of the centroid of the pulse that goes right
  double stress = 0.0;  ///< Pa, its largest
};

double speed_of(const Elastic& law, Wave wave) {
  return std::sqrt((wave == Wave::kP ? law.longitudinal_modulus() : law.mu) / law.density);
}

WaveResult travel(Wave wave, double refinement) {
  Body body = test::body_of(test::beam(scene::Layer::MATERIAL_ELASTIC, kLength, 4e-3, refinement));
  const auto along = [wave](Nodes& n, std::size_t i) -> double& { return wave == Wave::kP ? n.u[i] : n.v[i]; };
  const auto across = [wave](Nodes& n, std::size_t i) -> double& { return wave == Wave::kP ? n.v[i] : n.u[i]; };
  const auto pulse = [](double x) { return kSpeed * std::exp(-std::pow(x / kWidth, 2)); };
  test::for_each_node(body, [&](Nodes& n, std::size_t i) { along(n, i) = pulse(n.x0[i] - 0.5 * kLength); });
  const double c = speed_of(elastic_part(body.material(0)), wave);
  // Half of the usual step: at the whole one, errors of step and mesh nearly cancel in S waves, and no order is seen.
  const int steps = static_cast<int>(std::ceil(kPath / c / (0.45 * body.stable_step())));
  test::Stepper stepper(body, kPath / c / steps);
  for (int n = 0; n < steps; ++n) {
    stepper([&](Body& b) { test::for_each_node(b, [&](Nodes& nodes, std::size_t i) { across(nodes, i) = 0.0; }); });
  }
  WaveResult result;
  const double path = c * (stepper.time() - 0.5 * stepper.step());  // velocities belong to the middle of the step
  double wrong = 0.0, all = 0.0, sum = 0.0, moment = 0.0;
  test::for_each_node(body, [&](Nodes& n, std::size_t i) {
    const double x = n.x0[i] - 0.5 * kLength;
    const double expected = 0.5 * (pulse(x - path) + pulse(x + path));
    const double found = along(n, i);
    wrong += n.mass[i] * std::pow(found - expected, 2);
    all += n.mass[i] * expected * expected;
    if (x < 0.0) return;
    sum += n.mass[i] * found;
    moment += n.mass[i] * found * x;
  });
  result.error = std::sqrt(wrong / all);
  result.speed = moment / sum / (stepper.time() - 0.5 * stepper.step());
  const int row = body.mesh().row_count() / 2;
  for (int column = 0; column < body.mesh().columns; ++column) {
    const Stress s = body.stress(row, column, 0);
    result.stress = std::max(result.stress, std::abs(wave == Wave::kP ? s.xx : s.xy));
  }
  return result;
}

verification::Comparison comparison(const std::string& name, const std::string& quantity) {
  verification::Comparison result;
  result.group = "structure";
  result.name = name;
  result.quantity = quantity;
  result.reference = "closed form";
  return result;
}

void check_wave(Wave wave, const std::string& name, const std::string& speed_origin) {
  const Elastic law = Elastic::from_young(200e9, 0.3, 8000.0);
  const double c = speed_of(law, wave);
  const WaveResult coarse = travel(wave, 2.0), fine = travel(wave, 8.0);
  verification::Comparison order =
      comparison(name, "order of the velocity in the mesh, 10 to 40 elements in the width");
  order.origin = "d'Alembert's solution";
  order.expected = 2.0;
  order.found = 0.5 * std::log2(coarse.error / fine.error);
  order.tolerance = 0.1;
  order.reason = "discretisation: asymptotic range";
  verification::check(order);
  verification::Comparison speed = comparison(name, "speed of the pulse's centroid");
  speed.unit = "m/s";
  speed.origin = speed_origin;
  speed.expected = c;
  speed.found = fine.speed;
  speed.tolerance = 2e-4;
  speed.reason = "discretisation: dispersion of second order at 40 elements in the width";
  verification::check(speed);
  verification::Comparison stress = comparison(name, "largest stress");
  stress.unit = "Pa";
  stress.origin = "rho c v, v half of the start";
  stress.expected = law.density * c * 0.5 * kSpeed;
  stress.found = fine.stress;
  stress.tolerance = 2e-3;
  stress.reason = "discretisation: the same";
  verification::check(stress);
}

TEST(FeWave, PWave) { check_wave(Wave::kP, "P wave in plane strain", "c^2 = (lambda + 2 mu)/rho"); }
TEST(FeWave, SWave) { check_wave(Wave::kS, "S wave in plane strain", "c^2 = mu/rho"); }

TEST(FeWave, VelocityStep) {
  Body body = test::body_of(test::beam(scene::Layer::MATERIAL_ELASTIC, kLength, 4e-3, 2));
  const Elastic& law = elastic_part(body.material(0));
  const double c = speed_of(law, Wave::kP);
  // A ramp of eight elements keeps the oscillations of the mesh behind the front small.
  const auto initial = [](double x) { return kSpeed * std::clamp(0.5 - (x - 0.5 * kLength) / 16e-3, 0.0, 1.0); };
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) { nodes.u[i] = initial(nodes.x0[i]); });
  test::Stepper stepper(body, 0.9 * body.stable_step());
  while (stepper.time() < kPath / c) {
    stepper([](Body& b) { test::for_each_node(b, [](Nodes& nodes, std::size_t i) { nodes.v[i] = 0.0; }); });
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
  const std::string name = "Step of velocity in plane strain";
  verification::Comparison plateau = comparison(name, "mean stress of the plateau");
  plateau.unit = "Pa";
  plateau.origin = "-rho c V/2";
  plateau.expected = -0.5 * law.density * c * kSpeed;
  plateau.found = stress / count;
  plateau.tolerance = 2e-3;
  plateau.reason = "discretisation: ripples of the mesh behind the front";
  verification::check(plateau);
  verification::Comparison arrival = comparison(name, "place of the front");
  arrival.unit = "m";
  arrival.origin = "c t";
  arrival.expected = c * stepper.time();
  arrival.found = front - 0.5 * kLength;
  arrival.tolerance = 2.0 * body.mesh().width / kPath;
  arrival.reason = "discretisation: two elements";
  verification::check(arrival);
}

}  // namespace
}  // namespace grainstep::fe
