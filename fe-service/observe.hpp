/// @file What is reported about a body at an instant: ledgers, observables, snapshots. Velocities are handed in, for
/// the body's own belong to the middle of a step.
#pragma once

#include <optional>

#include "fe-service/body.hpp"
#include "grainstep/wire.pb.h"

namespace grainstep::fe {

/// Velocities of all nodes at one instant, m/s, laid out like the nodes' arrays.
struct Velocities {
  Array corner_u, corner_v, centre_u, centre_v;

  static Velocities of(const Body& body);

  /// before + weight (after - before), component by component.
  static Velocities blend(const Velocities& before, const Velocities& after, double weight);
};

[[nodiscard]] double kinetic_energy(const Body& body, const Velocities& at);  ///< J

/// J, at t(n) from the velocities before and after the step around it: m/2 v(n-1/2) . v(n+1/2), the kinetic energy that
/// central differences conserve together with the elastic one. It differs from m/2 V(n)^2 by m/8 (the step's change)^2,
/// which is no small part of it where a sudden pressure has just begun to push the surface. `at` is V(n) of an uneven
/// step as well: m/2 v(n-1/2) . (2 V(n) - v(n-1/2)).
[[nodiscard]] double conserved_kinetic_energy(const Body& body, const Velocities& before, const Velocities& at);

[[nodiscard]] Vec2 linear_momentum(const Body& body, const Velocities& at);      ///< N s
[[nodiscard]] double elastic_energy(const Body& body);                           ///< J, from the stress
[[nodiscard]] double max_surface_speed(const Body& body, const Velocities& at);  ///< m/s

struct PlasticExtent {
  double max_strain = 0.0;
  std::uint64_t elements = 0;  ///< that have flowed
};
[[nodiscard]] PlasticExtent plastic_extent(const Body& body);

/// Displacement against x2 (along the slug's travel) at mid-span, m.
[[nodiscard]] double back_deflection(const Body& body);
[[nodiscard]] double front_deflection(const Body& body);

/// eps_c: reduction of the core's thickness at mid-span over that thickness; nothing without a core.
[[nodiscard]] std::optional<double> core_compression(const Body& body);

void fill_snapshot(const Body& body, const Velocities& at, wire::Snapshot& snapshot);

}  // namespace grainstep::fe
