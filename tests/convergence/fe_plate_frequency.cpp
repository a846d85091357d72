// First two frequencies of a clamped circular plate, against Mindlin's plate and the thin one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../support/fe_mode.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kRadius = 0.5, kThick = kRadius / 20.0, kSlender = kRadius / 40.0, kYoung = 200e9, kPoisson = 0.3,
                 kDensity = 8000.0;
/// Roots of J_0(z) I_1(z) + I_0(z) J_1(z) = 0: omega = z^2/R^2 sqrt(D/(rho h)); z^2 = 10.216, 39.771.
constexpr std::array<double, 2> kRoot = {3.1962206, 6.3064370};

double bending_stiffness(double thickness) {
  return kYoung * std::pow(thickness, 3) / (12.0 * (1.0 - kPoisson * kPoisson));
}

double thin_plate(int mode, double thickness) {
  return std::pow(kRoot[mode] / kRadius, 2) * std::sqrt(bending_stiffness(thickness) / (kDensity * thickness));
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
double mindlin(int mode, double thickness) {
  const double rotary = thickness * thickness / 12.0;
  const double shear = bending_stiffness(thickness) / (5.0 / 6.0 * kYoung / (2.0 * (1.0 + kPoisson)) * thickness);
  const auto determinant = [&](double omega) {
    const double k4 = kDensity * thickness * omega * omega / bending_stiffness(thickness);
    const double root = std::sqrt(std::pow(rotary - shear, 2) + 4.0 / k4);
    const double first = 0.5 * k4 * (rotary + shear + root);
    const double second = 0.5 * k4 * (rotary + shear - root);
    const double scale = rotary * k4 - 1.0 / shear;
    const Wave a = wave(first, kRadius), b = wave(second, kRadius);
    return a.value * (first / scale - 1.0) * b.slope - b.value * (second / scale - 1.0) * a.slope;
  };
  double low = 0.95 * thin_plate(mode, thickness), high = thin_plate(mode, thickness);
  const bool sign = determinant(low) > 0.0;
  EXPECT_NE(sign, determinant(high) > 0.0) << "no root between, mode " << mode;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((determinant(middle) > 0.0) == sign ? low : high) = middle;
  }
  return low;
}

/// Circular frequency, started with the velocity of the thin plate's mode: sections normal to it.
double frequency(int mode, double thickness, int quads_through_thickness) {
  const scene::Structure plate =
      test::beam(scene::Layer::MATERIAL_ELASTIC, kRadius, thickness, 0.5 * quads_through_thickness);
  Body body(make_mesh(plate), make_layers(plate), Axisymmetric{});
  const double z = kRoot[mode];
  const double share = std::cyl_bessel_j(0.0, z) / std::cyl_bessel_i(0.0, z);
  const auto velocity = [&](const Nodes& nodes, std::size_t i) {
    const double s = z * nodes.x0[i] / kRadius;
    const double slope = -z / kRadius * (std::cyl_bessel_j(1.0, s) + share * std::cyl_bessel_i(1.0, s));
    return Vec2{-slope * (nodes.y0[i] + 0.5 * thickness),
                std::cyl_bessel_j(0.0, s) - share * std::cyl_bessel_i(0.0, s)};
  };
  return test::frequency_of_mode(body, thin_plate(mode, thickness), 0.9, velocity, test::in_clamps);
}

constexpr const char* kName = "Natural frequencies of a clamped circular plate";

verification::Comparison comparison(int mode, const std::string& quantity) {
  verification::Comparison result;
  result.group = "convergence";
  result.name = kName;
  result.quantity = "mode " + std::to_string(mode + 1) + ": " + quantity;
  result.reference = "closed form";
  return result;
}

TEST(FePlate, FirstTwoFrequenciesAreMindlins) {
  for (int mode = 0; mode < 2; ++mode) {
    const double found = frequency(mode, kSlender, 8);
    verification::Comparison thick = comparison(mode, "frequency, 8 quads in a thickness of 1/40 of the radius");
    thick.unit = "rad/s";
    thick.origin = "Mindlin's plate: J_0 and I_0 with rotary inertia and shear factor 5/6";
    thick.expected = mindlin(mode, kSlender);
    thick.found = found;
    thick.tolerance = 2e-3;
    thick.reason = "model: a held face cannot contract, which shortens the radius by some percent of the thickness";
    verification::check(thick);
    verification::Comparison thin = comparison(mode, "the same, thin plate");
    thin.unit = "rad/s";
    thin.origin = "omega = z^2/R^2 sqrt(D/(rho h)), z^2 = 10.216 and 39.771";
    thin.expected = thin_plate(mode, kSlender);
    thin.found = found;
    thin.tolerance = 1e-2;
    thin.reason = "model: shear and rotary inertia, a few times (thickness/R)^2 z^2";
    verification::check(thin);
  }
}

// Two errors of opposite sign: one dilatation in a quad makes it softer in bending, the linear displacements stiffer.
// Their sum is small (0.1% with 4 quads) and falls faster than in second order.
TEST(FePlate, FirstFrequencyConvergesInSecondOrderAtLeast) {
  const std::array<double, 3> found = {frequency(0, kThick, 4), frequency(0, kThick, 8), frequency(0, kThick, 16)};
  const double order = std::log2((found[0] - found[1]) / (found[1] - found[2]));
  verification::Comparison missing =
      comparison(0, "what the order in the mesh lacks of 2; 4, 8, 16 quads in a thickness of 1/20 of the radius");
  missing.origin = "constant-strain triangles: energies converge with h^2";
  missing.expected = 0.0;
  missing.found = std::max(0.0, 2.0 - order);
  missing.tolerance = 0.1;
  missing.reason = "discretisation: the order found is 2.5, of a sum of errors with opposite signs";
  verification::check(missing);
  EXPECT_LT(order, 3.0);
  verification::Comparison last = comparison(0, "change of the frequency from 8 to 16 quads, over itself");
  last.origin = "convergence";
  last.expected = 0.0;
  last.found = found[2] / found[1] - 1.0;
  last.tolerance = 5e-4;
  last.reason = "discretisation: a quarter of the change before, or less";
  verification::check(last);
}

}  // namespace
}  // namespace grainstep::fe
