/// @file Small structures for tests.
#pragma once

#include "grainstep/wire.pb.h"

namespace grainstep::fe::test {

inline scene::Layer steel(scene::Layer::Material material, double thickness) {
  scene::Layer layer;
  layer.set_material(material);
  layer.set_thickness(thickness);
  layer.set_density(8000.0);
  layer.set_young(200e9);
  layer.set_poisson(0.3);
  layer.set_yield_strength(470e6);
  layer.set_hardening_factor(1.5);
  layer.set_hardening_exponent(0.4);
  layer.set_rate_factor(0.015);
  layer.set_reference_rate(1.0);
  return layer;
}

inline scene::Structure beam(scene::Layer::Material material, double half_span, double thickness, double refinement) {
  scene::Structure structure;
  structure.set_type(scene::Structure::TYPE_BEAM);
  structure.set_half_span(half_span);
  structure.set_extent(scene::Structure::EXTENT_HALF);
  structure.mutable_mesh()->set_refinement(refinement);
  *structure.add_layers() = steel(material, thickness);
  return structure;
}

inline scene::Layer core(double thickness, double density, double viscosity) {
  scene::Layer layer;
  layer = steel(scene::Layer::MATERIAL_CORE, thickness);  // of its own it has only thickness, density and viscosity
  layer.set_density(density);
  layer.set_viscosity(viscosity);
  return layer;
}

/// The defaults of the scene's keys.
inline void set_core(scene::Structure& structure, double normalised_strength) {
  scene::Core& keys = *structure.mutable_core();
  keys.set_normalised_strength(normalised_strength);
  keys.set_poisson(0.25);
  keys.set_densification(scene::Core::DENSIFICATION_LOGARITHMIC);
  keys.set_densified_slope(0.1);
  keys.set_shock_width(0.1);
  keys.set_shear_ratio(1.0);
}

/// The defaults of the scene's keys.
inline scene::Guards usual_guards() {
  scene::Guards guards;
  guards.set_energy_drift(0.03);
  guards.set_momentum_error(1e-9);
  guards.set_overlap(0.5);
  guards.set_element_quality(0.01);
  return guards;
}

inline wire::Setup setup_of(const scene::Structure& structure, double depth = 1e-3) {
  wire::Setup setup;
  setup.set_protocol(wire::PROTOCOL_VERSION);
  setup.set_scene_hash(42);
  setup.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  setup.set_depth(depth);
  setup.set_mirror(structure.extent() == scene::Structure::EXTENT_HALF);
  *setup.mutable_structure()->mutable_structure() = structure;
  *setup.mutable_structure()->mutable_guards() = usual_guards();
  return setup;
}

}  // namespace grainstep::fe::test
