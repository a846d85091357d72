// The Taylor rod: a round copper bar flies end-on against a smooth wall. Its foot is one place of large,
// volume-preserving flow next to the axis, where elements that lock would show. The wall is the plane of symmetry of
// two equal bars that meet; the literature's range is from codes of many kinds.
#include <gtest/gtest.h>

#include <array>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kRadius = 3.2e-3, kLength = 32.4e-3, kSpeed = 227.0, kDuration = 80e-6, kYield = 400e6;

scene::Structure copper_rod(double across) {
  scene::Structure rod = test::beam(scene::Layer::MATERIAL_DH36, kRadius, kLength, 0.5 * kLength * across / kRadius);
  scene::Layer& copper = *rod.mutable_layers(0);
  copper.set_density(8930.0);
  copper.set_young(117e9);
  copper.set_poisson(0.35);
  copper.set_yield_strength(kYield);
  copper.set_hardening_factor(100e6 / kYield);  // linear, without rate
  copper.set_hardening_exponent(1.0);
  copper.set_rate_factor(0.0);
  return rod;
}

struct Shape {
  double length = 0.0, radius = 0.0;            ///< m
  double peak_strain = 0.0, quad_strain = 0.0;  ///< of a triangle; of a quad, the mean of its four
  double balance = 0.0;                         ///< energy at the end over that of the start
  double uneven_pressure = 0.0;                 ///< largest difference in a quad over the yield strength
};

Shape impact(double across) {
  const scene::Structure rod = copper_rod(across);
  Body body(make_mesh(rod), make_layers(rod), Axisymmetric{});
  const Mesh& mesh = body.mesh();
  const int last = mesh.row_count();
  test::for_each_node(body, [](Nodes& nodes, std::size_t i) { nodes.v[i] = -kSpeed; });
  const double start = kinetic_energy(body, Velocities::of(body));
  double time = 0.0, before = 0.0, step = 0.0, plastic = 0.0;
  int unconverged = 0;
  for (int n = 0; time < kDuration; ++n) {
    if (n % 10 == 0) step = 0.7 * body.stable_step();
    body.kick(0.5 * (before + step));
    for (int row = 0; row <= last; ++row) body.corners.u[mesh.corner({row, 0})] = 0.0;
    for (int column = 0; column <= mesh.columns; ++column) body.corners.v[mesh.corner({last, column})] = 0.0;
    body.drift(step);
    const SweepResult swept = body.sweep(step);
    unconverged += swept.unconverged;
    plastic += swept.plastic_work;
    time += step;
    before = step;
  }
  EXPECT_EQ(unconverged, 0);
  Shape result;
  result.length = body.corners.y[mesh.corner({0, 0})] - body.corners.y[mesh.corner({last, 0})];
  result.radius = body.corners.x[mesh.corner({last, mesh.columns})];
  result.peak_strain = plastic_extent(body).max_strain;
  result.balance = (plastic + elastic_energy(body) + kinetic_energy(body, Velocities::of(body))) / start;
  for (int row = 0; row < last; ++row) {
    for (int column = 0; column < mesh.columns; ++column) {
      double sum = 0.0, low = HUGE_VAL, high = -HUGE_VAL;
      for (int t = 0; t < kQuadTriangles; ++t) {
        const double pressure = -mean(body.stress(row, column, t));
        sum += body.plastic_strain(row, column, t);
        low = std::min(low, pressure);
        high = std::max(high, pressure);
      }
      result.quad_strain = std::max(result.quad_strain, 0.25 * sum);
      result.uneven_pressure = std::max(result.uneven_pressure, (high - low) / kYield);
    }
  }
  return result;
}

verification::Comparison comparison(const std::string& quantity, const std::string& unit) {
  verification::Comparison result;
  result.group = "convergence";
  result.name = "Taylor rod";
  result.quantity = quantity;
  result.unit = unit;
  result.reference = "literature";
  result.origin = "copper, 32.4 x 6.4 mm, 227 m/s, 80 us: ranges of published codes";
  return result;
}

void in_range(const std::string& quantity, const std::string& unit, double low, double high, double found) {
  verification::Comparison c = comparison(quantity, unit);
  c.expected = 0.5 * (low + high);
  c.found = found;
  c.tolerance = (high - low) / (high + low);
  c.reason = "model: the spread of published results";
  verification::check(c);
}

TEST(FeTaylorRod, FinalShapeOnThreeMeshes) {
  const std::array<double, 3> across = {4.0, 8.0, 16.0};
  std::array<Shape, 3> found;
  for (std::size_t i = 0; i < 3; ++i) {
    found[i] = impact(across[i]);
    std::printf(
        "%2.0f across: length %.3f mm, radius %.3f mm, strain %.3f, of a quad %.3f, energy %.4f, pressure %.2g\n",
        across[i], 1e3 * found[i].length, 1e3 * found[i].radius, found[i].peak_strain, found[i].quad_strain,
        found[i].balance, found[i].uneven_pressure);
  }
  const Shape& fine = found[2];
  in_range("final length, 16 quads across the radius", "m", 21.35e-3, 21.55e-3, fine.length);
  in_range("final radius of the foot", "m", 7.05e-3, 7.25e-3, fine.radius);
  // The published strains are those of meshes with 5 to 10 elements across. It is the last to
  // converge: 3.16, 3.44, 3.50.
  in_range("largest plastic strain, mean of a quad, 8 quads across", "", 3.1, 3.5, found[1].quad_strain);
  EXPECT_NEAR(fine.quad_strain / found[1].quad_strain, 1.0, 0.025);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_NEAR(found[i].length / found[i - 1].length, 1.0, 3e-3);
    EXPECT_NEAR(found[i].radius / found[i - 1].radius, 1.0, 6e-3);
  }
  verification::Comparison lost = comparison("order of the energy that is lost at the wall, in the mesh", "");
  lost.reference = "closed form";
  lost.origin = "nodes that meet the wall stop dead: the kinetic energy of half an element";
  lost.expected = 1.0;
  lost.found = std::log2((1.0 - found[1].balance) / (1.0 - fine.balance));
  lost.tolerance = 0.1;
  lost.reason = "discretisation: asymptotic range";
  verification::check(lost);
  verification::Comparison even = comparison("largest difference of pressure in a quad over the yield strength", "");
  even.reference = "closed form";
  even.origin = "one dilatation per quad";
  even.expected = 0.0;
  even.found = fine.uneven_pressure;
  even.tolerance = 1e-6;
  even.reason = "exact: round-off of 80000 steps on stresses of a hundred times the pressure";
  verification::check(even);
}

}  // namespace
}  // namespace grainstep::fe
