/// @file The energies of contacts between particles, as whoever computes these contacts gives them to a StepDriver.
#pragma once

#include <algorithm>

namespace grainstep::dem {

/// What this rank's contacts have dissipated since t = 0 and store now, J.
struct PairEnergy {
  double damping = 0.0;            ///< dissipated by dashpots
  double tangential = 0.0;         ///< into tangential springs and sliders
  double stored_normal = 0.0;      ///< at the last evaluation
  double stored_tangential = 0.0;  ///< likewise
  double largest_overlap = 0.0;    ///< over the sum of the radii, at the last evaluation

  PairEnergy& operator+=(const PairEnergy& other) {
    damping += other.damping;
    tangential += other.tangential;
    stored_normal += other.stored_normal;
    stored_tangential += other.stored_tangential;
    largest_overlap = std::max(largest_overlap, other.largest_overlap);
    return *this;
  }
};

}  // namespace grainstep::dem
