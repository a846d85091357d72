// Rotation turns the stress and does nothing else: prescribed (exact at any angle in a step), with stretch, and free.
#include <gtest/gtest.h>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kStep = 1e-7;

Body stressed_body() {
  Body body = test::body_of(test::beam(scene::Layer::MATERIAL_ELASTIC, 11e-3, 8e-3, 4));
  test::head_for(body, kStep, [](double x, double y) { return Vec2{x + 2e-2 * x - 1e-2 * y, y - 1.5e-2 * y}; });
  body.drift(kStep);
  body.sweep(kStep);
  return body;
}

/// Turns the body to an angle, from where its nodes were. (Turning on from where they are would add up that the
/// rounded cos^2 + sin^2 is not 1: a stretch.)
class Turning {
 public:
  explicit Turning(Body& body) : body_(body) {
    test::for_each_node(body, [this](const Nodes& nodes, std::size_t i) {
      start_.push_back({nodes.x[i], nodes.y[i]});
    });
  }

  void to(double angle) {
    auto from = start_.begin();
    test::for_each_node(body_, [&](Nodes& nodes, std::size_t i) {
      nodes.u[i] = (std::cos(angle) * from->x - std::sin(angle) * from->y - nodes.x[i]) / kStep;
      nodes.v[i] = (std::sin(angle) * from->x + std::cos(angle) * from->y - nodes.y[i]) / kStep;
      ++from;
    });
    body_.drift(kStep);
    body_.sweep(kStep);
  }

 private:
  Body& body_;
  std::vector<Vec2> start_;
};

double difference(const Stress& a, const Stress& b) {
  return std::max({std::abs(a.xx - b.xx), std::abs(a.yy - b.yy), std::abs(a.xy - b.xy), std::abs(a.zz - b.zz)});
}

class FeRotation : public testing::TestWithParam<int> {};

TEST_P(FeRotation, TwentyTurnsTurnTheStressAndNothingElse) {
  const int steps = 20 * GetParam();
  Body body = stressed_body();
  const Stress before = body.stress(3, 4, 2);
  const double energy = elastic_energy(body);
  Turning turning(body);
  for (int n = 1; n <= steps; ++n) turning.to(2.0 * M_PI * n / GetParam());
  const std::string name = "Rigid rotation by 20 turns";
  const std::string how = std::to_string(GetParam()) + " steps in a turn: ";
  // The body is 14 elements across, so each rounding of a position, a goal or a difference strains by 14 x 1.1e-16 at
  // random; positions do not drift, so that these strains cancel but for their meeting different angles. Gradients are
  // taken in the middle of the step, where a body that turns by 2 pi/n stands closer together by cos(pi/n).
  const double strain = 14.0 * 2.2e-16 * std::sqrt(steps) / std::cos(M_PI / GetParam());
  verification::check({.group = "structure",
                       .name = name,
                       .quantity = how + "change of stress / von Mises stress",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "R sigma R^T",
                       .expected = 0.0,
                       .found = difference(body.stress(3, 4, 2), before) / von_mises(before),
                       .tolerance = strain * elastic_part(body.material(0)).longitudinal_modulus() / von_mises(before),
                       .reason = "exact: round-off of positions, 3e-15 of strain in a step, at random"});
  verification::check({.group = "structure",
                       .name = name,
                       .quantity = how + "change of elastic energy",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "an invariant",
                       .expected = 0.0,
                       .found = elastic_energy(body) / energy - 1.0,
                       .tolerance = 1e-11,
                       .reason = "exact: twice the stress's round-off"});
}

INSTANTIATE_TEST_SUITE_P(StepsInATurn, FeRotation, testing::Values(3, 10, 100, 1000));

TEST(FeRotation, QuarterTurnSwapsTheComponents) {
  Body body = stressed_body();
  const Stress s = body.stress(3, 4, 2);
  Turning(body).to(0.5 * M_PI);
  verification::check({.group = "structure",
                       .name = "Quarter turn in one step",
                       .quantity = "error of stress / von Mises stress",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "(s11, s22, s12) -> (s22, s11, -s12)",
                       .expected = 0.0,
                       .found = difference(body.stress(3, 4, 2), {s.yy, s.xx, -s.xy, s.zz}) / von_mises(s),
                       .tolerance = 1e-12,
                       .reason = "exact: one step's round-off"});
}

/// A body stretched to 1.3 along its own axis 1 while it turns once; error of the stress in its own axes.
double turning_stretch_error(int steps) {
  Body body = test::body_of(test::beam(scene::Layer::MATERIAL_ELASTIC, 11e-3, 8e-3, 4));
  for (int n = 1; n <= steps; ++n) {
    const double angle = 2.0 * M_PI * n / steps;
    const double stretch = std::pow(1.3, static_cast<double>(n) / steps);
    test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
      const double x = stretch * nodes.x0[i];
      const double y = nodes.y0[i];
      nodes.u[i] = (std::cos(angle) * x - std::sin(angle) * y - nodes.x[i]) / kStep;
      nodes.v[i] = (std::sin(angle) * x + std::cos(angle) * y - nodes.y[i]) / kStep;
    });
    body.drift(kStep);
    body.sweep(kStep);
  }
  const Stress expected = elastic_part(body.material(0)).increment({std::log(1.3), 0.0, 0.0, 0.0});
  return difference(body.stress(3, 4, 2), expected) / von_mises(expected);
}

TEST(FeRotation, StretchInATurnConvergesWithTheStep) {
  const double error[] = {turning_stretch_error(100), turning_stretch_error(200), turning_stretch_error(400)};
  verification::check({.group = "structure",
                       .name = "Stretch to 1.3 during a turn",
                       .quantity = "order of the stress in the step",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "R (C : ln U) R^T with fixed axes of U",
                       .expected = 2.0,
                       .found = std::log2(error[1] / error[2]),
                       .tolerance = 0.05,
                       .reason = "discretisation: gradients and spin of the middle of the step"});
}

struct Spin {
  double angle = 0.0;            ///< rad
  double expected = 0.0;         ///< rad, of a rigid one
  double momentum_change = 0.0;  ///< of angular momentum, over its start
};

/// A free block set spinning at 1e5 rad/s, for 2 rad: angle of its diagonal.
Spin spin(int halvings) {
  Body body = test::body_of(test::beam(scene::Layer::MATERIAL_ELASTIC, 11e-3, 8e-3, 2));
  constexpr double kRate = 1e5;
  const double x_mid = 5.5e-3;
  const double y_mid = -4e-3;
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    nodes.u[i] = -kRate * (nodes.y0[i] - y_mid);
    nodes.v[i] = kRate * (nodes.x0[i] - x_mid);
  });
  const auto momentum = [&] {
    double sum = 0.0;
    test::for_each_node(body, [&](const Nodes& n, std::size_t i) {
      sum += n.mass[i] * ((n.x[i] - x_mid) * n.v[i] - (n.y[i] - y_mid) * n.u[i]);
    });
    return sum;
  };
  const double start = momentum();
  test::Stepper stepper(body, 0.2 * body.stable_step() / (1 << halvings));
  const int steps = 800 << halvings;
  Spin result;
  for (int n = 0; n < steps; ++n) {
    stepper([](Body&) {});
    result.momentum_change = std::max(result.momentum_change, std::abs(momentum() / start - 1.0));
  }
  const Nodes& c = body.corners;
  const std::size_t first = body.mesh().corner({body.mesh().row_count(), 0});
  const std::size_t last = body.mesh().corner({0, body.mesh().columns});
  result.angle = std::atan2(c.y[last] - c.y[first], c.x[last] - c.x[first]) - std::atan2(8.0, 11.0);
  result.expected = kRate * stepper.time();
  return result;
}

TEST(FeRotation, FreeSpinConvergesWithTheStep) {
  const Spin runs[] = {spin(0), spin(1), spin(2)};
  verification::check({.group = "structure",
                       .name = "Free spin",
                       .quantity = "largest change of angular momentum",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "central forces between nodes: x(n+1) x v(n+1/2) is conserved",
                       .expected = 0.0,
                       .found = runs[0].momentum_change,
                       .tolerance = 1e-11,
                       .reason = "exact: round-off of 4000 steps"});
  verification::check({.group = "structure",
                       .name = "Free spin",
                       .quantity = "order of the angle in the step",
                       .unit = "",
                       .reference = "order of the scheme",
                       .origin = "central differences",
                       .expected = 2.0,
                       .found = std::log2((runs[0].angle - runs[1].angle) / (runs[1].angle - runs[2].angle)),
                       .tolerance = 0.1,
                       .reason = "discretisation: asymptotic range"});
}

}  // namespace
}  // namespace grainstep::fe
