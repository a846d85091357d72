/// @file Spheres in a slice, for engine_rig.hpp: the reference particles as spheres of 1 mm, surfaces as rings.
#pragma once

#include <cmath>
#include <numbers>

#include "engine_rig.hpp"

namespace grainstep::dem::rig {

using surface::Vec3;

constexpr double degree = std::numbers::pi / 180.0;

/// Reference spheres of 1 mm (Kn in proportion to D) in a slug of radius and height 20 mm.
inline wire::Setup slice_setup(double slice = 30.0 * degree) {
  wire::Setup setup = reference_setup();
  setup.set_symmetry(scene::SYMMETRY_AXISYMMETRIC);
  slug_of(setup).set_height(0.02);
  slug_of(setup).set_slice_angle(slice);
  slug_of(setup).mutable_particle()->set_normal_stiffness(3.65e7);
  return setup;
}

/// Rings from the axis to `radius` that rise by `slope` per m.
inline void set_rings(wire::Setup& setup, double radius, int segments, double slope = 0.0) {
  std::vector<Vec2> nodes;
  for (int i = 0; i <= segments; ++i) nodes.push_back({{radius * i / segments, slope * radius * i / segments}});
  set_surface(setup, nodes);
}

/// The reference plate's slug (configs/small/plate-monolithic.yaml) at another diameter, m, on a rigid disc.
inline wire::Setup plate_slug(double diameter) {
  wire::Setup setup = slice_setup(10.0 * degree);
  scene::Slug& slug = slug_of(setup);
  slug.set_half_width(0.1);
  slug.set_height(0.15);
  slug.set_speed(320.8);
  slug.mutable_particle()->set_diameter(diameter);
  slug.mutable_particle()->set_normal_stiffness(3.65e10 * diameter);
  set_rings(setup, 0.5, 400);
  return setup;
}

struct Sphere {
  Vec3 position, velocity, spin;
};

inline Sphere sphere_of(const wire::Snapshot& snapshot, int i) {
  const wire::Field& velocity = field(snapshot, "velocity");
  const wire::Field& spin = field(snapshot, "angular_velocity");
  Sphere sphere;
  for (int c = 0; c < 3; ++c) {
    const auto at = static_cast<std::size_t>(c);
    sphere.position[at] = snapshot.position(3 * i + c);
    sphere.velocity[at] = velocity.value(3 * i + c);
    sphere.spin[at] = spin.value(3 * i + c);
  }
  return sphere;
}

/// Outwards at the polar angle theta.
inline Vec3 outward(double theta) { return {{std::cos(theta), 0.0, std::sin(theta)}}; }

}  // namespace grainstep::dem::rig
