/// @file How a grain lies in memory: one row of doubles for its state, one for the force on it.
///
/// Contact with surface and planes reads three components of everything (contact/particle_arrays.hpp). A disc's row is
/// one cache line in which the zeros of several vectors are the same ones: x1 x2 0 0 w v1 v2 0. Position, spin and
/// velocity begin at 0, 2 and 5; what is kicked is the quarter w v1 v2 0, to which the force t f1 f2 0 belongs.
#pragma once

#include <cstddef>

namespace grainstep::dem::native {

/// Four doubles that are loaded, added and stored as one.
using Quad [[gnu::vector_size(32), gnu::may_alias]] = double;

template <int D>
struct Row;

template <>
struct Row<2> {
  static constexpr std::ptrdiff_t size = 8, position = 0, spin = 2, velocity = 5;
  static constexpr std::ptrdiff_t force_size = 4, force = 1, torque = -2;  ///< a torque's zeros are added to others
  static constexpr std::ptrdiff_t turn = 2;  ///< component of spin and torque: the only one
};

template <>
struct Row<3> {
  static constexpr std::ptrdiff_t size = 12, position = 0, velocity = 4, spin = 8;
  static constexpr std::ptrdiff_t force_size = 8, force = 0, torque = 4;
  static constexpr std::ptrdiff_t turn = 0;
};

/// Floats per grain in the copy of positions that neighbours are looked for in.
template <int D>
inline constexpr std::ptrdiff_t place_size = D == 2 ? 2 : 4;

}  // namespace grainstep::dem::native
