// A bar that cannot strain sideways hits a rigid wall: an elastic precursor of the amplitude of the elastic limit, and
// a slower plastic wave. With linear hardening H (and no dependence on rate) everything is a closed form:
//     s_HEL = Y (1 - nu)/(1 - 2 nu),   c_e^2 = (lambda + 2 mu)/rho,   c_p^2 = (K + 4 G H/(3 (3 G + H)))/rho,
//     stress at the wall = s_HEL + rho c_p (V - s_HEL/(rho c_e))
// (Wang, Foundations of Stress Waves, chapters 2 and 7; c_p from d(s1 - s2) = 2 G H/(3 G + H) d(e1)).
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

// A tenth of the strength and of the speed: strains of 1e-3, so that the closed form of small strain holds to 1e-3.
constexpr double kYield = 47e6;
constexpr double kSpeed = 6.0;
constexpr double kLength = 0.2;
constexpr double kPoisson = 0.3;

Dh36 law_of(double hardening) {
  return {Elastic::from_young(200e9, kPoisson, 8000.0), kYield, hardening / kYield, 1.0, 0.0, 1.0};
}

struct Closed {
  double limit;          ///< Pa
  double elastic_speed;  ///< m/s
  double plastic_speed;  ///< m/s
  double wall;           ///< Pa, stress behind the plastic wave
  explicit Closed(const Dh36& law) {
    const Elastic& e = law.elastic;
    const double h = law.yield_strength * law.hardening_factor;
    limit = law.yield_strength * (1.0 - kPoisson) / (1.0 - 2.0 * kPoisson);
    elastic_speed = std::sqrt(e.longitudinal_modulus() / e.density);
    plastic_speed = std::sqrt((e.lambda + 2.0 / 3.0 * e.mu + 4.0 * e.mu * h / (3.0 * (3.0 * e.mu + h))) / e.density);
    wall = limit + e.density * plastic_speed * (kSpeed - limit / (e.density * elastic_speed));
  }
  [[nodiscard]] double stress(double x, double time) const {
    if (x > elastic_speed * time) return 0.0;
    return x > plastic_speed * time ? limit : wall;
  }
};

/// -stress 11 along the bar.
struct Profile {
  double time = 0.0;
  std::vector<double> x, stress;

  /// Where it falls through a level, seen from the far end.
  [[nodiscard]] double front(double level) const {
    for (std::size_t i = x.size() - 1; i-- > 0;) {
      if (stress[i] < level) continue;
      return x[i] + (x[i + 1] - x[i]) * (stress[i] - level) / (stress[i] - stress[i + 1]);
    }
    return 0.0;
  }
  [[nodiscard]] double mean(double from, double to) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] < from || x[i] > to) continue;
      sum += stress[i];
      ++count;
    }
    return sum / count;
  }
};

Profile profile_of(const Body& body, double time) {
  Profile profile{.time = time, .x = {}, .stress = {}};
  for (int column = 0; column < body.mesh().columns; ++column) {
    double sum = 0.0;
    for (int triangle = 0; triangle < kQuadTriangles; ++triangle) sum -= 0.25 * body.stress(0, column, triangle).xx;
    profile.x.push_back(body.mesh().corner_x(column) + 0.5 * body.mesh().width);
    profile.stress.push_back(sum);
  }
  return profile;
}

/// Profiles at half and at the end of the time in which the precursor crosses 0.8 of the bar.
std::array<Profile, 2> impact(const Dh36& law) {
  scene::Structure structure = test::beam(scene::Layer::MATERIAL_DH36, kLength, 0.25e-3, 1);
  scene::Layer& layer = *structure.mutable_layers(0);
  layer.set_yield_strength(law.yield_strength);
  layer.set_hardening_factor(law.hardening_factor);
  layer.set_hardening_exponent(law.hardening_exponent);
  layer.set_rate_factor(law.rate_factor);
  Body body = test::body_of(structure);
  // The wall stops the first elements little by little: without it the precursor rings.
  const double ramp = 40.0 * body.mesh().width;
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const double s = std::clamp(nodes.x0[i] / ramp, 0.0, 1.0);
    nodes.u[i] = -kSpeed * s * s * (3.0 - 2.0 * s);
  });
  const Closed closed(law);
  test::Stepper stepper(body, 0.9 * body.stable_step());
  std::array<Profile, 2> result;
  for (std::size_t k = 0; k < 2; ++k) {
    while (stepper.time() < 0.4 * static_cast<double>(k + 1) * kLength / closed.elastic_speed) {
      stepper([](Body& b) {
        test::for_each_node(b, [](Nodes& nodes, std::size_t i) { nodes.v[i] = 0.0; });
        for (int row = 0; row <= b.mesh().row_count(); ++row) b.corners.u[b.mesh().corner({row, 0})] = 0.0;
      });
    }
    result[k] = profile_of(body, stepper.time());
  }
  return result;
}

void check_impact(const std::string& name, double hardening) {
  const Dh36 law = law_of(hardening);
  const Closed closed(law);
  const std::array<Profile, 2> found = impact(law);
  const auto speed = [&](double level) {
    return (found[1].front(level) - found[0].front(level)) / (found[1].time - found[0].time);
  };
  const double slow = closed.plastic_speed * found[1].time;
  const double fast = closed.elastic_speed * found[1].time;
  const double gap = fast - slow;
  const auto check = [&](const char* quantity, const char* unit, const char* origin, double expected, double value,
                         double tolerance, const char* reason) {
    verification::check({.group = "structure",
                         .name = name,
                         .quantity = quantity,
                         .unit = unit,
                         .reference = "closed form",
                         .origin = origin,
                         .expected = expected,
                         .found = value,
                         .tolerance = tolerance,
                         .reason = reason});
  };
  check("stress of the precursor", "Pa", "Y (1 - nu)/(1 - 2 nu)", closed.limit,
        found[1].mean(slow + 0.3 * gap, fast - 0.3 * gap), 2e-3, "model: strains of 1e-3; discretisation: ripples");
  check("speed of the precursor", "m/s", "c^2 = (lambda + 2 mu)/rho", closed.elastic_speed, speed(0.5 * closed.limit),
        2e-3, "model: strains of 1e-3");
  check("stress at the wall", "Pa", "s_HEL + rho c_p (V - s_HEL/(rho c_e))", closed.wall,
        found[1].mean(0.2 * slow, 0.8 * slow), 2e-3, "model: strains of 1e-3");
  check("speed of the plastic wave", "m/s", "c^2 = (K + 4 G H/(3 (3 G + H)))/rho", closed.plastic_speed,
        speed(0.5 * (closed.limit + closed.wall)), 2e-3, "model: strains of 1e-3");
  verification::Curve plot{.group = "structure",
                           .name = name,
                           .title = "two waves",
                           .x_label = "distance from the wall, m",
                           .y_label = "axial pressure, Pa",
                           .axes = verification::Curve::Axes::linear,
                           .series = {}};
  for (const Profile& profile : found) {
    verification::Series exact{
        .label = "closed form", .x = profile.x, .y = {}, .mark = verification::Series::Mark::line};
    for (const double x : profile.x) exact.y.push_back(closed.stress(x, profile.time));
    plot.series.push_back({.label = "found", .x = profile.x, .y = profile.stress});
    plot.series.push_back(exact);
  }
  verification::curve(plot);
}

TEST(FeTwoWaves, PerfectlyPlastic) { check_impact("Elastic-plastic impact, perfectly plastic", 0.0); }
TEST(FeTwoWaves, LinearHardening) { check_impact("Elastic-plastic impact, linear hardening of 50 GPa", 50e9); }

}  // namespace
}  // namespace grainstep::fe
