// First two frequencies of a clamped circular plate, against Mindlin's plate and the thin one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kRadius = 0.5, kThickness = 0.0125, kYoung = 200e9, kPoisson = 0.3, kDensity = 8000.0;
/// Roots of J_0(z) I_1(z) + I_0(z) J_1(z) = 0: omega = z^2/R^2 sqrt(D/(rho h)); z^2 = 10.216, 39.771.
constexpr std::array<double, 2> kRoot = {3.1962206, 6.3064370};

double bending_stiffness() { return kYoung * std::pow(kThickness, 3) / (12.0 * (1.0 - kPoisson * kPoisson)); }

double thin_plate(int mode) {
  return std::pow(kRoot[mode] / kRadius, 2) * std::sqrt(bending_stiffness() / (kDensity * kThickness));
}

/// A radial solution of Mindlin's plate: deflection and slope at r.
struct Wave {
  double value, slope;
};

/// J_0 for a wave number squared above 0, I_0 below.
Wave wave(double squared, double r) {
  const double k = std::sqrt(std::abs(squared));
  if (squared > 0.0) return {std::cyl_bessel_j(0.0, k * r), -k * std::cyl_bessel_j(1.0, k * r)};
  return {std::cyl_bessel_i(0.0, k * r), k * std::cyl_bessel_i(1.0, k * r)};
}

/// Clamped circular Mindlin plate (R. D. Mindlin, H. Deresiewicz, J. Appl. Phys. 25 (1954) 1329), axisymmetric modes:
/// w = A w_1 + B w_2, rotation A (s_1 - 1) w_1' + B (s_2 - 1) w_2', both zero at R. Shear factor 5/6.
double mindlin(int mode) {
  const double rotary = kThickness * kThickness / 12.0;
  const double shear = bending_stiffness() / (5.0 / 6.0 * kYoung / (2.0 * (1.0 + kPoisson)) * kThickness);
  const auto determinant = [&](double omega) {
    const double k4 = kDensity * kThickness * omega * omega / bending_stiffness();
    const double root = std::sqrt(std::pow(rotary - shear, 2) + 4.0 / k4);
    const double first = 0.5 * k4 * (rotary + shear + root);
    const double second = 0.5 * k4 * (rotary + shear - root);
    const double scale = rotary * k4 - 1.0 / shear;
    const Wave a = wave(first, kRadius), b = wave(second, kRadius);
    return a.value * (first / scale - 1.0) * b.slope - b.value * (second / scale - 1.0) * a.slope;
  };
  double low = 0.95 * thin_plate(mode), high = thin_plate(mode);
  const bool sign = determinant(low) > 0.0;
  EXPECT_NE(sign, determinant(high) > 0.0) << "no root between, mode " << mode;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((determinant(middle) > 0.0) == sign ? low : high) = middle;
  }
  return low;
}

/// Circular frequency from half a period: the plate starts flat with the velocity of a mode, sections normal to it.
double frequency(int mode, int quads_through_thickness) {
  const scene::Structure plate =
      test::beam(scene::Layer::MATERIAL_ELASTIC, kRadius, kThickness, 0.5 * quads_through_thickness);
  Body body(make_mesh(plate), make_layers(plate), Axisymmetric{});
  const double z = kRoot[mode];
  const double share = std::cyl_bessel_j(0.0, z) / std::cyl_bessel_i(0.0, z);
  const auto velocity = [&](const Nodes& nodes, std::size_t i) {
    const double s = z * nodes.x0[i] / kRadius;
    const double slope = -z / kRadius * (std::cyl_bessel_j(1.0, s) + share * std::cyl_bessel_i(1.0, s));
    return Vec2{-slope * (nodes.y0[i] + 0.5 * kThickness),
                std::cyl_bessel_j(0.0, s) - share * std::cyl_bessel_i(0.0, s)};
  };
  std::array<std::vector<Vec2>, 2> shape;
  const auto of = [&](const Nodes& nodes) -> std::vector<Vec2>& { return shape[&nodes == &body.corners ? 0 : 1]; };
  for (auto& s : shape) s.resize(std::max(body.corners.x.size(), body.centres.x.size()));
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const Vec2 v = of(nodes)[i] = velocity(nodes, i);
    nodes.u[i] = 1e-3 * v.x;
    nodes.v[i] = 1e-3 * v.y;
  });
  const auto projection = [&] {
    double sum = 0.0;
    test::for_each_node(body, [&](const Nodes& nodes, std::size_t i) {
      const Vec2 moved{nodes.x[i] - nodes.x0[i], nodes.y[i] - nodes.y0[i]};
      sum += nodes.mass[i] * dot(moved, of(nodes)[i]);
    });
    return sum;
  };
  test::Stepper stepper(body, 0.9 * body.stable_step());
  const double half_period = M_PI / thin_plate(mode);
  double before = 0.0, time_before = 0.0;
  while (stepper.time() < 2.0 * half_period) {
    stepper([](Body& b) { (void)b.hold_supports(); });
    if (stepper.time() < 0.8 * half_period) continue;
    const double now = projection();
    if (now <= 0.0) return M_PI / (time_before + (stepper.time() - time_before) * before / (before - now));
    before = now;
    time_before = stepper.time();
  }
  ADD_FAILURE() << "does not return";
  return 0.0;
}

constexpr const char* kName = "Natural frequencies of a clamped circular plate";

void check(int mode, const std::string& quantity, const std::string& origin, double expected, double found,
           double tolerance, const std::string& reason) {
  verification::check({.group = "convergence",
                       .name = kName,
                       .quantity = "mode " + std::to_string(mode + 1) + ": " + quantity,
                       .unit = "",
                       .reference = "closed form",
                       .origin = origin,
                       .expected = expected,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = reason});
}

TEST(FePlate, FirstTwoFrequenciesConvergeToMindlinInSecondOrder) {
  for (int mode = 0; mode < 2; ++mode) {
    const std::array<double, 3> found = {frequency(mode, 2), frequency(mode, 4), frequency(mode, 8)};
    const double limit = found[2] - (found[1] - found[2]) / 3.0;
    check(mode, "order in the mesh, 2, 4, 8 quads through the thickness",
          "constant-strain triangles: energies converge with h^2", 2.0,
          std::log2((found[0] - found[1]) / (found[1] - found[2])), 0.1,
          "discretisation: the corners of the clamp are singular");
    check(mode, "limit of the mesh over Mindlin's plate, thickness 1/40 of the radius",
          "J_0 and I_0 with rotary inertia and shear factor 5/6", 1.0, limit / mindlin(mode), 5e-3,
          "model: a held face cannot contract, which shortens the radius by some percent of the thickness");
    check(mode, "the same over the thin plate", "omega = z^2/R^2 sqrt(D/(rho h)), z^2 = 10.216 and 39.771", 1.0,
          limit / thin_plate(mode), 0.02, "model: shear and rotary inertia, a few times (thickness/R)^2 z^2");
  }
}

}  // namespace
}  // namespace grainstep::fe
