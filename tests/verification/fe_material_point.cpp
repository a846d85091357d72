// DH36 (3.3) at a point, driven along paths of strain at rates over seven decades, against an integration of the flow
// rule as a differential equation.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "../support/flow_integration.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

/// Rates of stretch along two axes that are turned by 30 degrees, so that shear takes part; scaled by equivalent
/// strain.
struct PathLeg {
  double first, second;
  double strain;  ///< equivalent, of the leg
};
using Legs = std::vector<PathLeg>;

enum class Path { kRadial, kTurning };

Legs legs_of(Path path) {
  if (path == Path::kRadial) return {{1.0, -1.0, 0.02}, {-1.0, 1.0, 0.01}, {1.0, -1.0, 0.03}};
  return {{1.0, -1.0, 0.02}, {1.0, 1.0, 0.02}, {-1.0, 0.3, 0.02}};
}

constexpr double kAngle = M_PI / 6.0;

/// sqrt(2/3 dev D : dev D) of D = diag(a, b, 0).
double equivalent(double a, double b) { return 2.0 / 3.0 * std::sqrt(a * a - a * b + b * b); }

struct Point {
  std::array<double, 4> stress{};
  double plastic_strain = 0.0;
};

/// At the end of each leg.
std::vector<Point> integrate(const Dh36& law, const Legs& path, double rate) {
  const grainstep::test::FlowLaw flow{law.elastic.mu,         law.elastic.lambda + 2.0 / 3.0 * law.elastic.mu,
                                      law.yield_strength,     law.hardening_factor,
                                      law.hardening_exponent, law.rate_factor,
                                      law.reference_rate};
  grainstep::test::FlowIntegration point(flow);
  std::vector<Point> result;
  for (const PathLeg& leg : path) {
    const double scale = rate / equivalent(leg.first, leg.second);
    const double a = scale * leg.first, b = scale * leg.second;
    const double c = std::cos(kAngle), s = std::sin(kAngle);
    point.run({c * c * a + s * s * b, s * s * a + c * c * b, c * s * (a - b), leg.strain / rate});
    result.push_back({point.stress(), point.plastic_strain()});
  }
  return result;
}

/// The same by the elements: a block stretched along the turned axes, exponentially in time.
std::vector<Point> strain_block(const Legs& path, double rate, int steps_in_leg) {
  Body body = test::body_of(test::beam(scene::Layer::MATERIAL_DH36, 8e-3, 2e-3, 1));
  const double c = std::cos(kAngle), s = std::sin(kAngle);
  std::vector<Point> result;
  for (const PathLeg& leg : path) {
    const double scale = leg.strain / equivalent(leg.first, leg.second) / steps_in_leg;
    const double step = leg.strain / rate / steps_in_leg;
    const double grow_a = std::exp(scale * leg.first), grow_b = std::exp(scale * leg.second);
    for (int n = 0; n < steps_in_leg; ++n) {
      test::head_for(body, step, [&](double x, double y) {
        const double along = grow_a * (c * x + s * y);
        const double across = grow_b * (c * y - s * x);
        return Vec2{c * along - s * across, s * along + c * across};
      });
      body.drift(step);
      EXPECT_EQ(body.sweep(step).unconverged, 0);
    }
    const Stress at = body.stress(0, 2, 1);
    result.push_back({{at.xx, at.yy, at.xy, at.zz}, body.plastic_strain(0, 2, 1)});
  }
  return result;
}

struct Difference {
  double stress = 0.0;  ///< largest of any component at any leg's end, over Y
  double strain = 0.0;  ///< of the plastic strain, over the path's
};

Difference difference(const std::vector<Point>& found, const std::vector<Point>& expected) {
  Difference result;
  for (std::size_t leg = 0; leg < found.size(); ++leg) {
    for (std::size_t i = 0; i < 4; ++i) {
      result.stress = std::max(result.stress, std::abs(found[leg].stress[i] - expected[leg].stress[i]) / 470e6);
    }
    result.strain = std::max(result.strain, std::abs(found[leg].plastic_strain - expected[leg].plastic_strain) /
                                                expected.back().plastic_strain);
  }
  return result;
}

double mises(const Point& p) { return von_mises({p.stress[0], p.stress[1], p.stress[2], p.stress[3]}); }

verification::Comparison comparison(const std::string& path, const std::string& quantity) {
  verification::Comparison result;
  result.group = "structure";
  result.name = "DH36 at a point, " + path;
  result.quantity = quantity;
  result.reference = "ODE integration";
  result.origin = "flow rule with (3.3) by Dormand-Prince 5(4), error 1e-11 (tests/support/flow_integration.hpp)";
  return result;
}

struct Seen {
  double end_of_leg;  ///< Pa, von Mises stress after the first leg
  double expected;
};

Seen check_path(const Dh36& law, const std::string& name, Path path, double rate) {
  constexpr int kSteps = 2000;
  const Legs legs = legs_of(path);
  const std::vector<Point> expected = integrate(law, legs, rate);
  const std::vector<Point> found = strain_block(legs, rate, kSteps);
  const bool steps_matter = path == Path::kTurning || rate > law.reference_rate;
  const Difference fine = difference(found, expected);
  const Difference coarse = difference(strain_block(legs, rate, kSteps / 2), expected);
  const std::string at = fmt::format("at {:g}/s: ", rate);
  verification::Comparison stress = comparison(name, at + "largest error of stress / Y, 2000 steps in a leg");
  stress.found = fine.stress;
  stress.tolerance = steps_matter ? 1e-4 : 1e-9;
  stress.reason = steps_matter ? "discretisation: backward Euler in strain steps of 1e-5"
                               : "exact: one direction, no rate: the return's 1e-10";
  verification::check(stress);
  verification::Comparison strain = comparison(name, at + "largest error of plastic strain / its end, 2000 steps");
  strain.found = fine.strain;
  strain.tolerance = steps_matter ? 5e-4 : 1e-9;
  strain.reason = stress.reason;
  verification::check(strain);
  if (path == Path::kTurning) {
    verification::Comparison order = comparison(name, at + "order of the plastic strain in the step");
    order.expected = 1.0;
    order.found = std::log2(coarse.strain / fine.strain);
    order.tolerance = 0.12;
    order.reason = "discretisation: backward Euler; yield begins inside of a step, after which the rate term starts";
    verification::check(order);
  }
  return {mises(found.front()), mises(expected.front())};
}

const std::array<double, 8> kRates = {1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5};

TEST(FeMaterialPoint, ShearWithUnloadingOverSevenDecades) {
  const Dh36 law{Elastic::from_young(200e9, 0.3, 8000.0), 470e6, 1.5, 0.4, 0.015, 1.0};
  const std::string name = "shear, back and on";
  verification::Series expected{.label = "ODE", .x = {}, .y = {}, .mark = verification::Series::Mark::line};
  verification::Series found{.label = "elements", .x = {}, .y = {}};
  for (const double rate : kRates) {
    const Seen seen = check_path(law, name, Path::kRadial, rate);
    for (verification::Series* series : {&expected, &found}) series->x.push_back(rate);
    expected.y.push_back(seen.expected);
    found.y.push_back(seen.end_of_leg);
  }
  verification::curve({.group = "structure",
                       .name = "DH36 at a point, " + name,
                       .title = "flow stress at a strain of 0.02",
                       .x_label = "rate of strain, 1/s",
                       .y_label = "von Mises stress, Pa",
                       .axes = verification::Curve::Axes::log_x,
                       .series = {expected, found}});
}

TEST(FeMaterialPoint, TurningPathOverSevenDecades) {
  const Dh36 law{Elastic::from_young(200e9, 0.3, 8000.0), 470e6, 1.5, 0.4, 0.015, 1.0};
  for (const double rate : kRates) check_path(law, "three directions", Path::kTurning, rate);
}

}  // namespace
}  // namespace grainstep::fe
