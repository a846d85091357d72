/// @file All contacts between particles on one rank: who is near, who touches, forces, history, energy. No LAMMPS.
///
/// Only touching pairs carry history, and it is contiguous: both the pairs that may touch and those that touched in the
/// last step are sorted by their number, so that one pass over both brings them together. docs/decisions/0009.
///
/// Order of calls: whenever particles were reordered or left their margin clear(), then add() and adopt() for every
/// pair in the order in which forces are to be summed; evaluate() in every step.
#pragma once

#include <cstdint>
#include <vector>

#include "dem-service/pair/batch.hpp"
#include "dem-service/pair_energy.hpp"

namespace grainstep::dem {

/// Views of this rank's particles, ghosts included.
struct PairArrays {
  const double* position = nullptr;  ///< m, three each; LAMMPS keeps them in one block
  const double* velocity = nullptr;  ///< m/s, at t(n-1/2)
  const double* spin = nullptr;      ///< 1/s, likewise
  double* force = nullptr;           ///< N
  double* torque = nullptr;          ///< N m
  const double* radius = nullptr;    ///< m
  const double* mass = nullptr;      ///< kg
};

class PairContacts {
 public:
  PairContacts(const PairLaw& law, const PairFeatures& features);

  /// `largest_radius`: m, of all particles.
  void clear(double largest_radius);
  /// The next pair of the list, by their numbers among the particles.
  void add(int first, int second) { pairs_.push_back({first, second}); }
  /// The pair added last touched in the last step: values of HistoryLayout.
  void adopt(const double* values);

  /// Adds forces and torques. `grown`: s since the last step; 0 at the start.
  void evaluate(const PairArrays& particles, double grown);

  [[nodiscard]] const PairEnergy& energy() const { return energy_; }
  [[nodiscard]] int values_per_contact() const { return layout_.values; }
  [[nodiscard]] std::size_t count() const { return now_.size; }

  struct Pair {
    int first, second;
  };
  [[nodiscard]] const Pair& pair_of(std::size_t contact) const { return pairs_[now_.pair[contact]]; }
  [[nodiscard]] double value(std::size_t contact, int h) const { return now_.value[h][contact]; }
  /// What a value is multiplied by when the second particle of the pair becomes the first: springs point the other way.
  [[nodiscard]] double seen_from_second(int h) const { return h >= layout_.spring && h < layout_.torque ? -1.0 : 1.0; }

 private:
  /// Contacts of one step. Behind the last stands one with the highest number and no history.
  struct Contacts {
    std::vector<std::uint32_t> pair;
    std::vector<double> value[most_history_values];
    std::size_t size = 0;
    void reserve(std::size_t contacts, int values);
    void end(int values);
  };

  template <int D, bool Mixed>
  void find_near(const PairArrays& particles);
  template <int D, bool Friction>
  void sweep(const PairArrays& particles, double grown);
  template <int D, bool Friction>
  void flush(const PairArrays& particles, double grown, std::size_t first_contact);
  template <int D, bool Friction>
  void finish(const PairArrays& particles, double grown, std::size_t contact);

  PairLaw law_;
  PairFeatures features_;
  HistoryLayout layout_;
  PairKernel kernel_;
  double nearly_ = 0.0;  ///< m^2: pairs further apart cannot touch; of mixed sizes each pair's own radii say so
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> near_;
  std::size_t near_count_ = 0;
  Contacts before_, now_;
  PairBatch batch_;
  PairSums sums_;
  PairEnergy energy_;
};

/// Copies of the kernel that this machine can run, the fastest first.
[[nodiscard]] const std::vector<const PairKernels*>& available_pair_kernels();

}  // namespace grainstep::dem
