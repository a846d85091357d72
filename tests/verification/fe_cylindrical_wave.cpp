// A cylindrical wave: a ring of radial velocity in a solid cylinder splits into one that runs outwards, to the held rim
// and back, and one that runs inwards, through the axis. No strain along z. Against the series of the cylinder's modes,
// u = J_1(k_n r) with J_1(k_n R) = 0 and omega_n = k_n c, c^2 = (lambda + 2 mu)/rho.
#include <gtest/gtest.h>

#include <cmath>

#include "../support/fe_ring.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kRadius = 0.1;      // m
constexpr double kRing = 0.06;       // m, where the pulse begins
constexpr double kWidth = 8e-3;      // m, of the pulse
constexpr double kSpeed = 1e-2;      // m/s: small strains
constexpr double kThrough = 0.09;    // m, way: the inner part has gone through the axis and stands at r = 30 mm
constexpr double kGathered = 0.058;  // m: it stands about the axis
constexpr int kModes = 80;           // the pulse holds wavelengths down to some millimetres: 40 would do

double pulse(double r) { return kSpeed * std::exp(-std::pow((r - kRing) / kWidth, 2)); }

/// j with J_1(j) = 0, between the neighbours' middles (n + 1/4) pi.
double root(int n) {
  double low = (n - 0.25) * M_PI, high = (n + 0.75) * M_PI;
  const bool rises = std::cyl_bessel_j(1.0, low) < 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((std::cyl_bessel_j(1.0, middle) < 0.0) == rises ? low : high) = middle;
  }
  return low;
}

class Modes {
 public:
  Modes() {
    constexpr int intervals = 4000;
    constexpr double dr = kRadius / intervals;
    for (int n = 1; n <= kModes; ++n) {
      const double j = root(n);
      double sum = 0.0;  // the pulse vanishes at both ends: the trapezoidal rule is exact to round-off
      for (int i = 1; i < intervals; ++i)
        sum += pulse(i * dr) * std::cyl_bessel_j(1.0, j * i / intervals) * i * dr * dr;
      const double slope = std::cyl_bessel_j(0.0, j);
      k_.push_back(j / kRadius);
      share_.push_back(sum / (0.5 * kRadius * kRadius * slope * slope));
    }
  }

  /// Radial velocity, m/s, when waves have gone `way` m.
  [[nodiscard]] double velocity(double r, double way) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < k_.size(); ++n) {
      sum += share_[n] * std::cyl_bessel_j(1.0, k_[n] * r) * std::cos(k_[n] * way);
    }
    return sum;
  }

 private:
  std::vector<double> k_, share_;
};

struct Result {
  double error = 0.0;  ///< of velocity, root of mean squares over mass, over that of the closed form
  double highest = 0.0, expected_highest = 0.0;  ///< m/s
  verification::Series found{"", {}, {}, verification::Series::Mark::points};
  verification::Series expected{"modes", {}, {}, verification::Series::Mark::line};
};

Result travel(const Modes& modes, int columns, double way) {
  Body body = test::ring_of(columns, 1, kRadius / columns, 0.0);
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) { nodes.u[i] = pulse(nodes.x0[i]); });
  const Elastic& law = elastic_part(body.material(0));
  const double c = std::sqrt(law.longitudinal_modulus() / law.density);
  // Half of the usual step, as for plane waves: at the whole one errors of step and mesh partly cancel.
  const int steps = static_cast<int>(std::ceil(way / c / (0.45 * body.stable_step())));
  test::Stepper stepper(body, way / c / steps);
  for (int n = 0; n < steps; ++n) {
    stepper([&](Body& b) {
      for (const int row : {0, 1}) {
        b.corners.u[b.mesh().corner({row, 0})] = 0.0;
        b.corners.u[b.mesh().corner({row, columns})] = 0.0;
      }
      test::for_each_node(b, [](Nodes& nodes, std::size_t i) { nodes.v[i] = 0.0; });
    });
  }
  const double gone = way - 0.5 * c * stepper.step();  // velocities belong to the middle of the step
  Result result;
  double wrong = 0.0, all = 0.0;
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const double expected = modes.velocity(nodes.x0[i], gone);
    wrong += nodes.mass[i] * std::pow(nodes.u[i] - expected, 2);
    all += nodes.mass[i] * expected * expected;
    result.highest = std::max(result.highest, std::abs(nodes.u[i]));
    result.expected_highest = std::max(result.expected_highest, std::abs(expected));
  });
  for (int column = 0; column <= columns; ++column) {
    const std::size_t i = body.mesh().corner({0, column});
    result.found.x.push_back(body.corners.x0[i] / kRadius);
    result.found.y.push_back(body.corners.u[i] / kSpeed);
    result.expected.x.push_back(result.found.x.back());
    result.expected.y.push_back(modes.velocity(body.corners.x0[i], gone) / kSpeed);
  }
  result.error = std::sqrt(wrong / all);
  return result;
}

TEST(FeAxisymmetric, CylindricalWaveThroughTheAxis) {
  const Modes modes;
  const std::string name = "Cylindrical wave through the axis of a solid cylinder";
  verification::Comparison comparison{.group = "structure",
                                      .name = name,
                                      .quantity = {},
                                      .unit = "",
                                      .reference = "closed form",
                                      .origin = "series of J_1(k_n r) cos(k_n c t), J_1(k_n R) = 0",
                                      .expected = 0.0,
                                      .found = 0.0,
                                      .tolerance = 0.0,
                                      .reason = {}};
  const auto check = [&](const std::string& quantity, double expected, double found, double tolerance,
                         const std::string& reason) {
    comparison.quantity = quantity;
    comparison.expected = expected;
    comparison.found = found;
    comparison.tolerance = tolerance;
    comparison.reason = reason;
    verification::check(comparison);
  };
  Result coarse = travel(modes, 100, kThrough), fine = travel(modes, 200, kThrough);
  check("error of the velocity after the axis, rms, 16 quads in the pulse's width", 0.0, fine.error, 0.02,
        "discretisation: second order");
  check("order in the mesh, 8 and 16 quads in the width", 2.0, std::log2(coarse.error / fine.error), 0.1,
        "discretisation: asymptotic range");
  const Result gathered = travel(modes, 200, kGathered);
  check("largest velocity about the axis over that at the start", gathered.expected_highest / kSpeed,
        gathered.highest / kSpeed, 0.01, "discretisation: the same");
  coarse.found.label = "8 quads in the width";
  fine.found.label = "16 quads in the width";
  verification::curve({.group = "structure",
                       .name = name,
                       .title = "after the axis",
                       .x_label = "r / R",
                       .y_label = "radial velocity over its largest at the start",
                       .series = {coarse.found, fine.found, fine.expected}});
}

}  // namespace
}  // namespace grainstep::fe
