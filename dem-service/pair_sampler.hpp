/// @file What the contacts between particles store and dissipate. LAMMPS's pair style does not tell, so its own
/// half neighbour list is swept with its own single(), on the steps where a sample is wanted.
#pragma once

#include "dem-service/lammps_fmt.hpp"

#include <lammps/pair.h>

#include <cstdint>
#include <vector>

#include "dem-service/particle_arrays.hpp"

namespace LAMMPS_NS {
class Atom;
}

namespace grainstep::dem {

struct PairSample {
  double stored_normal = 0.0;      ///< J
  double stored_tangential = 0.0;  ///< J
  double dashpot_power = 0.0;      ///< W, dissipated by dashpots
  double tangential_power = 0.0;   ///< W, into tangential springs and sliders
  double largest_overlap = 0.0;    ///< over the mean diameter
};

class PairSampler {
 public:
  /// Per particle: dashpot force, tangential force, torque.
  static constexpr int values_per_particle = 9;

  struct Stiffness {
    double normal = 0.0;      ///< N/m
    double tangential = 0.0;  ///< N/m
  };
  explicit PairSampler(const Stiffness& stiffness) : stiffness_(stiffness) {}

  /// After the pair forces were computed, velocities at t(n-1/2): dashpot and tangential forces of every particle,
  /// ghosts included, and what is stored.
  void sweep(LAMMPS_NS::Pair& pair, const LAMMPS_NS::Atom& atom);

  /// The values of particle i; a ghost's are to be added to its owner's.
  [[nodiscard]] double* values(int i) { return &values_[static_cast<std::size_t>(values_per_particle * i)]; }

  /// With velocities at t(n): the exact power of the step. Sums over this rank's particles.
  [[nodiscard]] PairSample finish(const ParticleArrays& particles);

 private:
  void touch(LAMMPS_NS::Pair& pair, const LAMMPS_NS::Atom& atom, int i, int j, const surface::Vec3& apart,
             double squared);

  Stiffness stiffness_;
  std::vector<double> values_;
  PairSample sample_;
};

}  // namespace grainstep::dem
