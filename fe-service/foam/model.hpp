/// @file Everything that follows from the keys of a slug and its foam (4.7) to (4.14): the block, its material, its
/// mesh, its contact, its steps.
#pragma once

#include "fe-service/materials/foam.hpp"
#include "fe-service/mesh.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::fe {

/// SI. Frame of the block: x1 along the structure from the slug's axis, x2 from the leading face to the tail.
struct FoamModel {
  Mesh mesh;  ///< the loaded-face row of the structure's meshes is the tail here
  Foam foam;
  double depth;  ///< b
  double height;
  double speed, tail_speed;  ///< at the leading face and the tail, linear between
  double angle;              ///< rad, of block and velocity from the normal
  double offset;             ///< x1 of the leading face's middle
  double stand_off;          ///< gap at the start
  bool confined;             ///< the sides do not move along x1

  double radius;                ///< m: a node touches at this distance from the surface
  double contact_stiffness;     ///< N/m, of a node
  double tangential_stiffness;  ///< N/m
  double friction;
};

/// Throws InputError for what cannot be computed. `mirror`: half of it, with symmetry at x1 = 0.
[[nodiscard]] FoamModel make_foam_model(const scene::Impactor& impactor, double depth, bool mirror);

/// rho_bar rho_s, kg/m^3.
[[nodiscard]] double foam_density(const scene::Slug& slug);

/// eps_D = 1 - rho_bar/rho_max                                                                             (4.13)
[[nodiscard]] double locking_strain(const scene::Impactor& impactor);

/// 2/omega_max of the block and its contact, s: `elements` is the block's own. A node in touch gains
/// contact_stiffness/mass of omega^2; the lightest touching node is taken.
[[nodiscard]] double stable_step_in_touch(const FoamModel& model, double elements);

/// The step that a block wants, s, from its stable step at the start: elements that lock keep rho_bar/rho_max of their
/// height, and omega^2 is inverse to that.
[[nodiscard]] double preferred_foam_step(const scene::Impactor& impactor, double stable_step);

}  // namespace grainstep::fe
