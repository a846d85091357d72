/// @file What a slug will cost and how it will step: what a participant says before a run is started. No LAMMPS, no
/// MPI.
#pragma once

#include <cstdint>

#include "grainstep/scene.pb.h"
#include "grainstep/wire.pb.h"

namespace grainstep::dem {

struct SlugPreview {
  std::uint64_t particles = 0;
  double particle_mass = 0.0;            ///< kg, mean
  double mass = 0.0;                     ///< kg, of all particles; of a slice's those of the full circle
  double smallest = 0.0, largest = 0.0;  ///< m, diameters
  double contact_mass = 0.0;        ///< kg, of the largest; of a slice's sphere as a ring of the full circle feels it
  double contact_time = 0.0;        ///< s, t_e of a pair of the smallest (2.4)
  double stable_step = 0.0;         ///< s
  double preferred_step = 0.0;      ///< s, what `auto` takes: t_e/10
  std::uint64_t memory_bytes = 0;   ///< estimate
  std::uint64_t process_bytes = 0;  ///< the part of it that every rank takes
  double seconds_per_particle_step = 0.0;  ///< estimate, one core
  bool point_contact = false;              ///< the scene asks for it

  /// The same as the message; without the scene. `surface`: what will be hit; empty where that is not known.
  [[nodiscard]] wire::Ready ready(const wire::Surface& surface) const;
};

/// Throws InputError for what this impactor cannot compute, e.g. a solid fraction above what its packing reaches.
[[nodiscard]] SlugPreview preview(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth, bool mirror);

}  // namespace grainstep::dem
