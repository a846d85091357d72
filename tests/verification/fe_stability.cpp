// Central differences are stable up to 2/omega_max of the assembled body and not beyond. What the body gives as its
// stable step lies below that, and not far; there the energy of an elastic body stays where it is, beyond it grows.
#include <gtest/gtest.h>

#include <random>

#include "../support/fe_matrices.hpp"
#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "fe-service/layers.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kSide = 1e-3;  // m, of a quad

/// A block of 10 x 6 quads, stiff on top of soft and light, with every node off its place by up to `part` of a side
/// (masses stay those of the square).
Body distorted_body(double part, const Measure& measure = PlaneStrain{1e-3}) {
  scene::Structure structure = test::beam(scene::Layer::MATERIAL_ELASTIC, 10 * kSide, 3 * kSide, 3);
  *structure.add_layers() = test::steel(scene::Layer::MATERIAL_ELASTIC, 3 * kSide);
  structure.mutable_layers(1)->set_young(60e9);
  structure.mutable_layers(1)->set_density(2400.0);
  Body body(make_mesh(structure), make_layers(structure), measure);
  std::mt19937 random(3);
  const auto shift = [&] { return part * kSide * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0); };
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const double moved = shift();
    const bool held = is_of_revolution(body.measure()) && nodes.x0[i] == 0.0;
    nodes.x[i] += held ? 0.0 : moved;
    nodes.y[i] += shift();
  });
  return body;
}

void hold_axis(Body& body) {
  for (int row = 0; row <= body.mesh().row_count(); ++row) body.corners.u[body.mesh().corner({row, 0})] = 0.0;
}

/// Largest over initial energy of free vibrations from random velocities (so small that shapes do not change).
double growth(Body body, double step, int steps) {
  std::mt19937 random(5);
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const double along = 1e-6 * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0);
    nodes.u[i] = is_of_revolution(body.measure()) && nodes.x0[i] == 0.0 ? 0.0 : along;
    nodes.v[i] = 1e-6 * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0);
  });
  const double initial = kinetic_energy(body, Velocities::of(body));
  double largest = initial;
  for (int n = 0; n < steps && largest < 1e12 * initial; ++n) {
    body.kick(n == 0 ? 0.0 : step);
    if (is_of_revolution(body.measure())) hold_axis(body);
    body.drift(step);
    body.sweep(step);
    largest = std::max(largest, kinetic_energy(body, Velocities::of(body)));
  }
  return largest / initial;
}

void check(double part, const std::string& quantity, double expected, double found, double tolerance,
           const std::string& reason) {
  verification::check(
      {.group = "structure",
       .name = "stable step of a body with nodes off their places by " + std::to_string(part).substr(0, 3) + " sides",
       .quantity = quantity,
       .unit = "",
       .reference = "central differences: 2/omega_max, from the assembled matrices",
       .origin = "eigenvalues of M^-1 K; docs/theory/structure.md",
       .expected = expected,
       .found = found,
       .tolerance = tolerance,
       .reason = reason});
}

class Stability : public testing::TestWithParam<double> {};

TEST_P(Stability, TheBoundIsSafeAndNear) {
  const Body body = distorted_body(GetParam());
  const double limit = 2.0 / std::sqrt(test::body_frequency(body));
  EXPECT_LE(body.stable_step(), limit * (1.0 + 1e-12));
  check(GetParam(), "the body's stable step over the limit (never above 1)", 1.0, body.stable_step() / limit, 0.15,
        "model: a quad alone takes more of the highest mode than in a body, where its neighbours share the corners");
}

TEST_P(Stability, EnergyIsBoundedBelowTheBoundAndGrowsAboveTheLimit) {
  const Body body = distorted_body(GetParam());
  const double limit = 2.0 / std::sqrt(test::body_frequency(body));
  // What central differences conserve is kinetic energy at mid-step plus V(n+1/2) . F(n) terms; at 0.95 of the limit
  // the kinetic part of one mode may swing by 1/(1 - 0.95^2) = 10.
  constexpr const char* swing = "model: the kinetic part of one mode swings by 1/(1 - (step/limit)^2)";
  check(GetParam(), "largest over initial kinetic energy, 20000 steps of 0.95 of the body's own", 1.0,
        growth(body, 0.95 * body.stable_step(), 20000), 9.0, swing);
  check(GetParam(), "the same in steps of 0.99 of the limit", 1.0, growth(body, 0.99 * limit, 20000), 49.0, swing);
  check(GetParam(), "whether it passes a million in steps of 1.01 of the limit", 1.0,
        growth(body, 1.01 * limit, 20000) > 1e6 ? 1.0 : 0.0, 0.0, "exact: yes");
}

// A disc of the same section. Its quads have one dilatation each, which is softer than the matrices of the bound.
TEST_P(Stability, OfADisc) {
  const Body body = distorted_body(GetParam(), Axisymmetric{});
  const double limit = 2.0 / std::sqrt(test::body_frequency(body));
  EXPECT_LE(body.stable_step(), limit * (1.0 + 1e-12));
  const auto check_disc = [&](const std::string& quantity, double found, double tolerance, const std::string& reason) {
    verification::check({.group = "structure",
                         .name = "stable step of a disc with nodes off their places by " +
                                 std::to_string(GetParam()).substr(0, 3) + " sides",
                         .quantity = quantity,
                         .unit = "",
                         .reference = "central differences: 2/omega_max, from the assembled matrices",
                         .origin = "eigenvalues of M^-1 K with the hoop term; docs/theory/structure.md",
                         .expected = 1.0,
                         .found = found,
                         .tolerance = tolerance,
                         .reason = reason});
  };
  check_disc("the body's stable step over the limit (never above 1)", body.stable_step() / limit, 0.25,
             "model: a quad alone takes more of the highest mode than in a body; most so at the axis");
  check_disc("largest over initial kinetic energy, 20000 steps of 0.95 of the body's own",
             growth(body, 0.95 * body.stable_step(), 20000), 9.0,
             "model: the kinetic part of one mode swings by 1/(1 - (step/limit)^2)");
}

INSTANTIATE_TEST_SUITE_P(Shapes, Stability, testing::Values(0.0, 0.1, 0.2));

}  // namespace
}  // namespace grainstep::fe
