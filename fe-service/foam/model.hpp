/// @file Everything that follows from the keys of a slug and its foam (4.7) to (4.14): the block, its material, its
/// mesh, its contact, its steps. In a solid of revolution the block is a cylinder about the axis.
#pragma once

#include "fe-service/materials/foam.hpp"
#include "fe-service/measure.hpp"
#include "fe-service/mesh.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::fe {

/// SI. Frame of the block: x1 along the structure from the slug's axis (or the radius), x2 from the leading face to the
/// tail.
struct FoamModel {
  Mesh mesh;  ///< the loaded-face row of the structure's meshes is the tail here
  Foam foam;
  Measure measure;
  double height;
  double speed, tail_speed;  ///< at the leading face and the tail, linear between
  double angle;              ///< rad, of block and velocity from the normal
  double offset;             ///< x1 of the leading face's middle
  double stand_off;          ///< gap at the start
  bool confined;             ///< the sides do not move along x1

  double radius;                ///< m: a node touches at this distance from the surface
  double contact_stiffness;     ///< N/m over m^2 of the undeformed outline that is a node's (outline_areas())
  double tangential_stiffness;  ///< likewise
  double friction;
};

/// The scene around the slug.
struct FoamSetting {
  scene::Symmetry symmetry;
  double depth;  ///< m, of plane strain
  bool mirror;   ///< half of it, with symmetry at x1 = 0; a solid of revolution has its axis there
};

/// Throws InputError for what cannot be computed.
[[nodiscard]] FoamModel make_foam_model(const scene::Impactor& impactor, const FoamSetting& setting);

/// The step that a block wants, s, from its stable step at the start: elements that lock keep rho_bar/rho_max of their
/// height, and omega^2 is inverse to that.
[[nodiscard]] double preferred_foam_step(const FoamModel& model, double stable_step);

/// Nodes of the leading face swing on their contacts within a few of its steps, and all at once where the block
/// arrives: with four or more of them in a window the exchange takes 1 to 2% of the energy, with two 0.01%
/// (docs/theory/foam.md).
inline constexpr double kFoamStepsPerWindow = 2.0;

/// What a bare number in steps.impactor counts: a foam's preferred step is a tenth of it, like a slug's of its contact
/// time.
inline constexpr double kFoamStepsPerContact = 10.0;

}  // namespace grainstep::fe
