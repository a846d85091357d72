/// @file Momentum and place of initial velocities.
#include "fe-service/initial_velocity.hpp"

#include <gtest/gtest.h>

#include "../../support/fe_motion.hpp"
#include "../../support/fe_scenes.hpp"
#include "fe-service/layers.hpp"

namespace grainstep::fe {
namespace {

/// 0.1 m by 0.02 m: 15 by 6 elements of two layers, the lower one half as dense.
scene::Structure two_layers() {
  scene::Structure structure = test::beam(scene::Layer::MATERIAL_ELASTIC, 0.1, 0.01, 3);
  *structure.add_layers() = test::steel(scene::Layer::MATERIAL_ELASTIC, 0.01);
  structure.mutable_layers(1)->set_density(4000.0);
  return structure;
}

scene::InitialVelocity& add(scene::Structure& structure, double x1, double x2) {
  scene::InitialVelocity& field = *structure.add_initial_velocity();
  field.set_x1(x1);
  field.set_x2(x2);
  return field;
}

void range(scene::Range& range, double from, double to) {
  range.set_from(from);
  range.set_to(to);
}

Body moving(const scene::Structure& structure) {
  Body body(make_mesh(structure), make_layers(structure), PlaneStrain{1e-3});
  set_initial_velocity(structure, body);
  return body;
}

Vec2 momentum(const scene::Structure& structure) {
  const Body body = moving(structure);
  return linear_momentum(body, Velocities::of(body));
}

// 0.0123 to 0.0456 m ends within elements.
TEST(InitialVelocity, APatchHasTheMomentumOfItsMass) {
  scene::Structure structure = two_layers();
  range(*add(structure, 3.0, -7.0).mutable_patch(), 0.0123, 0.0456);
  const double mass = (8000.0 + 4000.0) * 0.01 * 0.0333 * 1e-3;
  EXPECT_NEAR(momentum(structure).x, 3.0 * mass, 1e-13 * mass);
  EXPECT_NEAR(momentum(structure).y, -7.0 * mass, 1e-13 * mass);
}

TEST(InitialVelocity, LayersAndDepthsAddUp) {
  scene::Structure structure = two_layers();
  scene::InitialVelocity& lower = add(structure, 0.0, -7.0);
  lower.set_layer(1);
  range(*lower.mutable_patch(), 0.01, 0.05);
  scene::InitialVelocity& thin = add(structure, 0.0, 2.0);
  range(*thin.mutable_depth(), 0.009, 0.011);
  range(*thin.mutable_patch(), 0.01, 0.05);
  const double expected = (-7.0 * 4000.0 * 0.01 + 2.0 * (8000.0 + 4000.0) * 0.001) * 0.04 * 1e-3;
  EXPECT_NEAR(momentum(structure).y, expected, 1e-13);
}

TEST(InitialVelocity, EverywhereIsOneVelocityButForWhatIsHeld) {
  scene::Structure structure = two_layers();
  add(structure, 3.0, -7.0);
  Body body = moving(structure);
  test::for_each_node(body, [](Nodes& nodes, std::size_t i) {
    const bool clamped = nodes.x0[i] > 0.1 - 1e-9;
    const bool mirrored = nodes.x0[i] < 1e-9;
    EXPECT_NEAR(nodes.u[i], clamped || mirrored ? 0.0 : 3.0, 1e-12);
    EXPECT_NEAR(nodes.v[i], clamped ? 0.0 : -7.0, 1e-12);
  });
}

TEST(InitialVelocity, ARigidTargetHasItsMean) {
  scene::Structure structure = two_layers();
  EXPECT_EQ(mean_initial_velocity(structure, PlaneStrain{1e-3}).y, 0.0);
  add(structure, 0.0, -6.0).set_layer(0);
  EXPECT_DOUBLE_EQ(mean_initial_velocity(structure, PlaneStrain{1e-3}).y, -4.0);
  range(*structure.mutable_initial_velocity(0)->mutable_patch(), 0.05, 0.3);
  EXPECT_DOUBLE_EQ(mean_initial_velocity(structure, PlaneStrain{1e-3}).y, -2.0);
}

// A ring's part of the momentum of a field that covers a part of its elements: by area, on any mesh.
TEST(InitialVelocity, OfADiscGoesByArea) {
  scene::Structure structure = test::beam(scene::Layer::MATERIAL_ELASTIC, 0.1, 0.02, 3);
  scene::InitialVelocity& field = *structure.add_initial_velocity();
  field.set_x2(-4.0);
  field.mutable_patch()->set_from(0.0);
  field.mutable_patch()->set_to(0.05);
  Body body(make_mesh(structure), make_layers(structure), Axisymmetric{});
  set_initial_velocity(structure, body);
  const double expected = -4.0 * 8000.0 * 0.02 * M_PI * 0.05 * 0.05;
  EXPECT_NEAR(linear_momentum(body, Velocities::of(body)).y / expected, 1.0, 1e-12);
  EXPECT_NEAR(mean_initial_velocity(structure, Axisymmetric{}).y, -1.0, 1e-14);
}

}  // namespace
}  // namespace grainstep::fe
