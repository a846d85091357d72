/// @file What a LAMMPS script has made, as the engine needs to know it to attach contact with the surface.
#pragma once

#include "dem-service/slug/model.hpp"
#include "grainstep/scene.pb.h"
#include "grainstep/wire.pb.h"

namespace grainstep::dem {

/// Of all ranks.
struct DeckParticles {
  std::uint64_t count = 0;
  double smallest = 0.0, largest = 0.0;   ///< m, diameters
  double lightest = 0.0, heaviest = 0.0;  ///< kg
  double mass = 0.0;                      ///< kg, of all
  double step = 0.0;                      ///< s, the script's timestep
  int dimension = 3;
  bool own_pair_style = false;  ///< grainstep/hooke: it keeps the energies of its contacts
};

/// InputError for a scene that scripts cannot load.
void require_deck_scene(const wire::Setup& setup);

/// Throws InputError for what cannot touch a surface: points, no particles, another dimension than the surface's.
[[nodiscard]] SlugModel make_deck_model(const scene::DeckContact& contact, const DeckParticles& particles);

/// What the participant says of it; without scene and memory.
[[nodiscard]] wire::Ready ready_of(const SlugModel& model, const DeckParticles& particles);

}  // namespace grainstep::dem
