/// @file What touches the surface, as its owner holds it: a rank's particles (discs or spheres), or the boundary nodes
/// of a block as discs. Views, valid until particles are next sorted or exchanged.
#pragma once

#include <cstdint>

#include "surface/vec.hpp"

namespace grainstep::contact {

struct ParticleArrays {
  int owned = 0;
  const double* const* position = nullptr;  ///< m
  const double* const* velocity = nullptr;  ///< m/s; t(n-1/2) until the step's end, t(n) there
  const double* const* spin = nullptr;      ///< 1/s, likewise
  double* const* force = nullptr;           ///< N
  double* const* torque = nullptr;          ///< N m
  const double* radius = nullptr;           ///< m
  const double* mass = nullptr;             ///< kg
  const double* share = nullptr;            ///< by which the law's stiffnesses are multiplied; null: 1 for all
  const std::int32_t* identity = nullptr;
  surface::Vec3* spring = nullptr;  ///< m, tangential spring of the contact with the surface; zero without contact
};

inline surface::Vec2 in_plane(const double* a) { return {{a[0], a[1]}}; }
inline surface::Vec3 vector_of(const double* a) { return {{a[0], a[1], a[2]}}; }
inline void add_to(double* a, const surface::Vec3& b) {
  for (std::size_t i = 0; i < 3; ++i) a[i] += b[i];
}

}  // namespace grainstep::contact
