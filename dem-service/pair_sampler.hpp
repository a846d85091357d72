/// @file What the contacts between particles store and dissipate. LAMMPS's pair style does not tell, so its own half
/// neighbour list is swept with its own single(), on the steps where a sample is wanted.
///
/// Order of calls, after the pair forces were summed up and while velocities stand at t(n-1/2): synchronise(); pass the
/// values of particles on to their ghosts; sweep().
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

/// Every stride-th particle of the list, from `offset` on: its contacts count `stride` times.
struct SweepPart {
  int stride = 1;
  int offset = 0;
};

class PairSampler {
 public:
  /// Per particle: velocity and spin at t(n).
  static constexpr int values_per_particle = 6;

  struct Law {
    double normal_stiffness = 0.0;      ///< N/m
    double tangential_stiffness = 0.0;  ///< N/m; 0: no tangential force
    double largest_diameter = 0.0;      ///< m
    double dt = 0.0;                    ///< s
  };
  explicit PairSampler(const Law& law) : law_(law) {}

  /// What the velocities will be at t(n): half a step on with the forces that are complete by now.
  void synchronise(const LAMMPS_NS::Atom& atom);

  [[nodiscard]] double* values(int i) { return &values_[static_cast<std::size_t>(values_per_particle * i)]; }

  /// This rank's contacts. Their power is exact: force of the step times velocities at t(n).
  [[nodiscard]] PairSample sweep(LAMMPS_NS::Pair& pair, const LAMMPS_NS::Atom& atom, const SweepPart& part);

 private:
  void touch(LAMMPS_NS::Pair& pair, const LAMMPS_NS::Atom& atom, int i, int j, const surface::Vec3& apart,
             double squared, PairSample& sample);

  Law law_;
  std::vector<double> values_;
};

}  // namespace grainstep::dem
