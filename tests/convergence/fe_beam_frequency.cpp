// The first three frequencies of a clamped beam in plane strain converge with the mesh in second order, to those of a
// Timoshenko beam with the plane-strain modulus E/(1 - nu^2), the closer the more slender the beam is.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <unsupported/Eigen/MatrixFunctions>

#include "../support/fe_mode.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kHalfSpan = 0.5;
constexpr double kSpan = 2.0 * kHalfSpan;
constexpr double kModulus = 200e9 / (1.0 - 0.3 * 0.3);
constexpr double kDensity = 8000.0;
constexpr int kModes = 3;
/// Roots of cos(beta L) cosh(beta L) = 1 (Blevins, Formulas for natural frequency and mode shape, table 8-1).
constexpr std::array<double, kModes> kRoot = {4.730040744862704, 7.853204624095838, 10.995607838001671};

/// Shape of a clamped Euler-Bernoulli beam and its slope, xi = x/L in 0..1.
struct Shape {
  double value, slope;
};

Shape shape(int mode, double xi) {
  const double b = kRoot[mode];
  const double sigma = (std::cosh(b) - std::cos(b)) / (std::sinh(b) - std::sin(b));
  const double z = b * xi;
  return {std::cosh(z) - std::cos(z) - sigma * (std::sinh(z) - std::sin(z)),
          b / kSpan * (std::sinh(z) + std::sin(z) - sigma * (std::cosh(z) - std::cos(z)))};
}

double euler_bernoulli(int mode, double thickness) {
  return std::pow(kRoot[mode] / kSpan, 2) * std::sqrt(kModulus * thickness * thickness / 12.0 / kDensity);
}

/// Circular frequency, started with the velocity of Euler and Bernoulli's mode: sections normal to the axis.
double frequency(int mode, double thickness, int quads_through_thickness) {
  scene::Structure structure =
      test::beam(scene::Layer::MATERIAL_ELASTIC, kHalfSpan, thickness, 0.5 * quads_through_thickness);
  structure.set_extent(scene::Structure::EXTENT_FULL);
  Body body = test::body_of(structure);
  const auto velocity = [&](const Nodes& nodes, std::size_t i) {
    const Shape s = shape(mode, (nodes.x0[i] + kHalfSpan) / kSpan);
    return Vec2{-s.slope * (nodes.y0[i] + 0.5 * thickness), s.value};
  };
  return test::frequency_of_mode(body, euler_bernoulli(mode, thickness), 0.9, velocity, test::in_clamps);
}

/// Clamped Timoshenko beam (shear factor 5/6), by the transfer matrix of (w/L, phi, M L/(EI), Q L^2/(EI)) over x/L.
double timoshenko(int mode, double thickness) {
  const double bending = kModulus * std::pow(thickness, 3) / 12.0;
  const double shear = 200e9 / 2.6 * thickness * 5.0 / 6.0;
  const auto determinant = [&](double omega) {
    const double inertia = kDensity * thickness * omega * omega * kSpan * kSpan / bending;
    Eigen::Matrix4d system = Eigen::Matrix4d::Zero();
    system(0, 1) = 1.0;
    system(0, 3) = bending / (shear * kSpan * kSpan);
    system(1, 2) = 1.0;
    system(2, 1) = -inertia * thickness * thickness / 12.0;
    system(2, 3) = -1.0;
    system(3, 0) = -inertia * kSpan * kSpan;
    const Eigen::Matrix4d transfer = system.exp();
    return transfer(0, 2) * transfer(1, 3) - transfer(0, 3) * transfer(1, 2);
  };
  double low = 0.85 * euler_bernoulli(mode, thickness);
  double high = euler_bernoulli(mode, thickness);
  const bool sign = determinant(low) > 0.0;
  EXPECT_NE(sign, determinant(high) > 0.0) << "no root between, mode " << mode;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((determinant(middle) > 0.0) == sign ? low : high) = middle;
  }
  return low;
}

struct Found {
  std::array<double, 3> frequency;  ///< 1/s, 2, 4 and 8 quads through the thickness
  [[nodiscard]] double order() const {
    return std::log2((frequency[0] - frequency[1]) / (frequency[1] - frequency[2]));
  }
  [[nodiscard]] double limit() const { return frequency[2] - (frequency[1] - frequency[2]) / 3.0; }
};

Found series(int mode, double thickness) {
  return {{frequency(mode, thickness, 2), frequency(mode, thickness, 4), frequency(mode, thickness, 8)}};
}

constexpr const char* kName = "Natural frequencies of a clamped beam";
constexpr double kThick = 0.05, kSlender = 0.025;

verification::Comparison comparison(const std::string& quantity) {
  verification::Comparison result;
  result.group = "convergence";
  result.name = kName;
  result.quantity = quantity;
  return result;
}

void check_mode(int mode, const Found& found) {
  const std::string which = "mode " + std::to_string(mode + 1) + ": ";
  verification::Comparison order = comparison(which + "order in the mesh, 2, 4, 8 quads through the thickness");
  order.reference = "order of the elements";
  order.origin = "constant-strain triangles: energies converge with h^2";
  order.expected = 2.0;
  order.found = found.order();
  order.tolerance = 0.08;
  order.reason = "discretisation: the corners of the clamps are singular";
  verification::check(order);
  verification::Comparison limit = comparison(which + "limit of the mesh, thickness 1/40 of the span");
  limit.unit = "rad/s";
  limit.reference = "closed form";
  limit.origin = "Timoshenko beam, E/(1 - nu^2), shear factor 5/6; roots of its transfer matrix";
  limit.expected = timoshenko(mode, kSlender);
  limit.found = found.limit();
  limit.tolerance = 2.5e-3;
  limit.reason = "model: a held face cannot contract, which shortens the beam by some 3% of its thickness";
  verification::check(limit);
}

/// What is left of the difference is the model's: it falls with the thickness, and at the same mesh in the same order.
void check_model_error(const Found& slender) {
  const auto difference = [](const Found& found, double thickness) {
    return found.limit() / timoshenko(0, thickness) - 1.0;
  };
  verification::Comparison scaling =
      comparison("mode 1: difference of the limits at 1/20 of the span over that at 1/40");
  scaling.reference = "scaling of the model's error";
  scaling.origin = "a shortening in proportion to the thickness";
  scaling.expected = 2.0;
  scaling.found = difference(series(0, kThick), kThick) / difference(slender, kSlender);
  scaling.tolerance = 0.1;
  scaling.reason = "model: next order of thickness over span";
  verification::check(scaling);
}

TEST(FeBeam, FirstThreeFrequenciesConvergeToTimoshenkoInSecondOrder) {
  verification::Curve plot{.group = "convergence",
                           .name = kName,
                           .title = "error of the frequency",
                           .x_label = "quads through the thickness",
                           .y_label = "difference from the limit / limit",
                           .axes = verification::Curve::Axes::log_log,
                           .series = {}};
  for (int mode = 0; mode < kModes; ++mode) {
    const Found slender = series(mode, kSlender);
    check_mode(mode, slender);
    if (mode == 0) check_model_error(slender);
    verification::Series points{.label = "mode " + std::to_string(mode + 1), .x = {2.0, 4.0, 8.0}, .y = {}};
    for (const double f : slender.frequency) points.y.push_back(f / slender.limit() - 1.0);
    plot.series.push_back(points);
  }
  plot.series.push_back(
      {.label = "second order", .x = {2.0, 8.0}, .y = {0.08, 0.005}, .mark = verification::Series::Mark::line});
  verification::curve(plot);
}

}  // namespace
}  // namespace grainstep::fe
