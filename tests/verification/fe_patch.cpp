// Patch tests: a linear motion of all nodes gives one stress everywhere and no force inside, on a distorted mesh, for
// small and for finite strain.
#include <gtest/gtest.h>

#include <random>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kStep = 1e-7;
constexpr double kRoundOff = 1e-12;
constexpr const char* kReason = "exact: positions are rounded to 1e-16 of the body, 1e-15 of an element";

/// Interior nodes are displaced at random by up to a fifth of an element.
Body distorted_body() {
  Body body = test::body_of(test::beam(scene::Layer::MATERIAL_ELASTIC, 11e-3, 8e-3, 4));
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

struct Gradient {
  double xx, xy, yx, yy;
};

/// In one step: x becomes x + l x.
void move(Body& body, const Gradient& l) {
  test::head_for(body, kStep, [&](double x, double y) {
    return Vec2{x + l.xx * x + l.xy * y, y + l.yx * x + l.yy * y};
  });
  body.drift(kStep);
  body.sweep(kStep);
}

/// Largest difference of any triangle's stress from the expected, over its scale.
double stress_error(const Body& body, const Stress& expected) {
  double worst = 0.0;
  test::for_each_triangle(body, [&](int row, int column, int triangle) {
    const Stress s = body.stress(row, column, triangle);
    for (const double error : {s.xx - expected.xx, s.yy - expected.yy, s.xy - expected.xy, s.zz - expected.zz}) {
      worst = verification::larger(worst, std::abs(error));
    }
  });
  return worst / von_mises(expected);
}

/// Largest force on a node inside, over that of the stress on an element's side.
double force_error(const Body& body, const Stress& stress) {
  double worst = 0.0;
  for (int row = 1; row < body.mesh().row_count(); ++row) {
    for (int column = 1; column < body.mesh().columns; ++column) {
      const std::size_t i = body.mesh().corner({row, column});
      worst = std::max({worst, std::abs(body.corners.fx[i]), std::abs(body.corners.fy[i])});
    }
  }
  return worst / (von_mises(stress) * 1e-3 * 1e-3);
}

void check(const std::string& what, const std::string& quantity, const std::string& origin, double found) {
  verification::check({.group = "structure",
                       .name = "Patch test, " + what,
                       .quantity = quantity,
                       .unit = "",
                       .reference = "closed form",
                       .origin = origin,
                       .expected = 0.0,
                       .found = found,
                       .tolerance = kRoundOff,
                       .reason = kReason});
}

TEST(FePatch, SmallLinearMotion) {
  Body body = distorted_body();
  move(body, {2e-2, -1e-2, 5e-3, -1.5e-2});
  // Gradient at the middle of the step: L (I + L/2)^-1.
  const double a = 2e-2, b = -1e-2, c = 5e-3, d = -1.5e-2;
  const double det = (1.0 + 0.5 * a) * (1.0 + 0.5 * d) - 0.25 * b * c;
  const double xx = (a * (1.0 + 0.5 * d) - 0.5 * b * c) / det;
  const double xy = (-0.5 * a * b + b * (1.0 + 0.5 * a)) / det;
  const double yx = (c * (1.0 + 0.5 * d) - 0.5 * d * c) / det;
  const double yy = (-0.5 * c * b + d * (1.0 + 0.5 * a)) / det;
  const Stress middle = elastic_part(body.material(0)).increment({xx, yy, xy + yx, 0.0});
  // ... and from there to the end of the step the stress turns by half of the step's angle.
  const double angle = 2.0 * std::atan(0.25 * (yx - xy));
  const double co = std::cos(0.5 * angle), si = std::sin(0.5 * angle);
  const Stress expected{co * co * middle.xx - 2.0 * co * si * middle.xy + si * si * middle.yy,
                        si * si * middle.xx + 2.0 * co * si * middle.xy + co * co * middle.yy,
                        co * si * (middle.xx - middle.yy) + (co * co - si * si) * middle.xy, middle.zz};
  const std::string origin = "sigma = r (C : sym(L (I + L/2)^-1)) r^T, r: half of the rotation; one step";
  check("small strain", "stress, largest error of any triangle / von Mises stress", origin,
        stress_error(body, expected));
  check("small strain", "largest force inside / force on a side", "balance of forces", force_error(body, expected));
}

// A pure stretch keeps its axes: the rate form integrates to logarithms, and step by step to 2 (r - 1)/(r + 1).
TEST(FePatch, FiniteStretch) {
  constexpr int kSteps = 100;
  const double stretch_x = 1.5;
  const double stretch_y = 0.8;
  Body body = distorted_body();
  const double rx = std::pow(stretch_x, 1.0 / kSteps) - 1.0;
  const double ry = std::pow(stretch_y, 1.0 / kSteps) - 1.0;
  for (int n = 0; n < kSteps; ++n) move(body, {rx, 0.0, 0.0, ry});
  const auto summed = [](double r) { return kSteps * 2.0 * r / (2.0 + r); };
  const Stress expected = elastic_part(body.material(0)).increment({summed(rx), summed(ry), 0.0, 0.0});
  check("stretch by 1.5 x 0.8", "stress, largest error of any triangle / von Mises stress",
        "sigma = C : sum of 2 (r - 1)/(r + 1) over 100 equal steps", stress_error(body, expected));
  check("stretch by 1.5 x 0.8", "largest force inside / force on a side", "balance of forces",
        force_error(body, expected));
  const Stress limit = elastic_part(body.material(0)).increment({std::log(stretch_x), std::log(stretch_y), 0.0, 0.0});
  verification::check({.group = "structure",
                       .name = "Patch test, stretch by 1.5 x 0.8",
                       .quantity = "stress 11",
                       .unit = "Pa",
                       .reference = "closed form",
                       .origin = "sigma = C : ln U",
                       .expected = limit.xx,
                       .found = body.stress(3, 4, 2).xx,
                       .tolerance = 1e-5,
                       .reason = "discretisation: (ln 1.5/100)^2/12 = 1.4e-6 of the larger strain"});
}

// Jaumann's rate in simple shear (Dienes, Acta Mechanica 32 (1979) 217): the stress swings instead of growing.
TEST(FePatch, FiniteSimpleShear) {
  constexpr double kShear = 2.0;
  const auto error_of = [](int steps) {
    Body body = distorted_body();
    for (int n = 0; n < steps; ++n) move(body, {0.0, kShear / steps, 0.0, 0.0});
    const double mu = elastic_part(body.material(0)).mu;
    const Stress expected{mu * (1.0 - std::cos(kShear)), -mu * (1.0 - std::cos(kShear)), mu * std::sin(kShear), 0.0};
    EXPECT_LT(stress_error(body, body.stress(0, 0, 0)), kRoundOff);
    return stress_error(body, expected);
  };
  const double error[] = {error_of(100), error_of(200), error_of(400)};
  verification::check({.group = "structure",
                       .name = "Simple shear to gamma = 2",
                       .quantity = "order of the stress in the step",
                       .unit = "",
                       .reference = "closed form",
                       .origin = "sigma_12 = G sin gamma, sigma_11 = G (1 - cos gamma)",
                       .expected = 2.0,
                       .found = std::log2(error[1] / error[2]),
                       .tolerance = 0.05,
                       .reason = "discretisation: gradients and spin of the middle of the step"});
}

}  // namespace
}  // namespace grainstep::fe
