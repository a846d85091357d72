/// @file All contacts between particles on one rank: who is near, who touches, forces, history, energy. No LAMMPS.
///
/// Only touching pairs carry history, and it is contiguous: both the pairs that may touch and those that touched in the
/// last step are sorted by their number, so that one pass over both brings them together. docs/decisions/0009.
///
/// Order of calls: whenever particles were reordered or left their margin clear(), then add() and adopt() for every
/// pair in the order in which forces are to be summed, or set_pairs() and adopt() for those that touched;
/// evaluate() in every step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "dem-service/law/pair_energy.hpp"
#include "dem-service/pair/batch.hpp"
#include "dem-service/pair/outside_forces.hpp"
#include "dem-service/pair/pair.hpp"

namespace grainstep::dem {

/// Views of this rank's particles, ghosts included.
struct PairArrays {
  const double* position = nullptr;  ///< m, of the first; of discs two components are read
  const double* velocity = nullptr;  ///< m/s, at t(n-1/2)
  const double* spin = nullptr;      ///< 1/s, likewise
  double* force = nullptr;           ///< N
  double* torque = nullptr;          ///< N m
  const double* radius = nullptr;    ///< m
  const double* mass = nullptr;      ///< kg
  // Doubles from one particle's vector to the next one's; LAMMPS has three of each in a block of their own.
  std::ptrdiff_t stride = 3;        ///< of position, velocity and spin
  std::ptrdiff_t force_stride = 3;  ///< of force and torque
  // Forces on these are added at once, on the second of a pair that is none of them later: PairContacts::outside().
  std::int32_t first = 0;
  std::int32_t last = std::numeric_limits<std::int32_t>::max();
};

class PairContacts {
 public:
  PairContacts(const PairLaw& law, const PairFeatures& features);

  /// `largest_radius`: m, of all particles.
  void clear(double largest_radius);
  /// The next pair of the list, by their numbers among the particles.
  void add(int first, int second) {
    own_pairs_.push_back({first, second});
    pairs_ = own_pairs_;
  }
  /// All pairs at once; they stay where they are.
  void set_pairs(std::span<const Pair> pairs) { pairs_ = pairs; }
  /// This pair touched in the last step: values of HistoryLayout. In the order of pairs.
  void adopt(std::size_t pair, const double* values);
  /// The pair added last did.
  void adopt(const double* values) { adopt(pairs_.size() - 1, values); }

  /// All particles are alike, m and kg: nothing need be read of each.
  void set_equal(double radius, double mass);

  /// Adds forces and torques. `grown`: s since the last step; 0 at the start.
  void evaluate(const PairArrays& particles, double grown);
  /// Likewise of `near` alone, the numbers of pairs that may touch; all others do not.
  void evaluate(const PairArrays& particles, double grown, std::span<const std::uint32_t> near);

  [[nodiscard]] const PairEnergy& energy() const { return energy_; }

  /// Those that touched in the last step, with their histories, and energies. Read back after clear() and set_pairs().
  template <class Archive>
  void serialize(Archive& archive) {
    std::vector<std::uint32_t> touching(now_.pair.begin(), now_.pair.begin() + static_cast<std::ptrdiff_t>(now_.size));
    archive("pairs that touch", touching);
    std::vector<double> history;
    for (std::size_t n = 0; n < now_.size; ++n) {
      for (int h = 0; h < layout_.values; ++h) history.push_back(value(n, h));
    }
    archive("their histories", history);
    archive("energies", energy_);
    if constexpr (Archive::loads) adopt_all(touching, history);
  }
  /// Of the last step.
  [[nodiscard]] OutsideForces& outside() { return outside_; }
  [[nodiscard]] int values_per_contact() const { return layout_.values; }
  [[nodiscard]] std::size_t count() const { return now_.size; }

  [[nodiscard]] std::span<const Pair> pairs() const { return pairs_; }
  [[nodiscard]] const Pair& pair_of(std::size_t contact) const { return pairs_[now_.pair[contact]]; }
  [[nodiscard]] double value(std::size_t contact, int h) const { return now_.value[h][contact]; }
  /// What a value is multiplied by when the second particle of the pair becomes the first: springs point the other way.
  [[nodiscard]] double seen_from_second(int h) const { return h >= layout_.spring && h < layout_.torque ? -1.0 : 1.0; }

 private:
  /// Contacts of one step. Behind the last stands one with the highest number and no history.
  struct Contacts {
    std::vector<std::uint32_t> pair;
    std::array<std::vector<double>, most_history_values> value;
    std::size_t size = 0;
    void reserve(std::size_t contacts, int values);
    void end(int values);
  };

  void adopt_all(const std::vector<std::uint32_t>& touching, const std::vector<double>& history);
  template <int D, bool Mixed>
  void find_near(const PairArrays& particles);
  template <int D, bool Friction, bool Equal>
  void sweep(const PairArrays& particles, double grown, std::span<const std::uint32_t> near);
  template <int D, bool Equal>
  std::size_t find_touching(const PairArrays& particles, std::span<const std::uint32_t> near);
  template <int D, bool Friction, bool Equal>
  void gather(const PairArrays& particles, std::size_t first_contact);
  template <int D, bool Friction>
  std::size_t hand_on(const PairArrays& particles, double grown, std::size_t first_contact, std::size_t old);
  template <int D, bool Friction>
  void flush(const PairArrays& particles, double grown, std::size_t first_contact);
  template <int D, bool Friction, bool Equal>
  void add_forces(const PairArrays& particles, std::size_t first_contact);
  template <int D, bool Friction>
  void finish(const PairArrays& particles, double grown, std::size_t contact);

  PairLaw law_;
  PairFeatures features_;
  HistoryLayout layout_;
  PairKernel kernel_;
  double equal_radius_ = 0.0;  ///< m; 0: they are not
  double nearly_ = 0.0;        ///< m^2: pairs further apart cannot touch; of mixed sizes each pair's own radii say so
  std::vector<Pair> own_pairs_;
  std::span<const Pair> pairs_;
  std::vector<std::uint32_t> near_;
  std::size_t near_count_ = 0;
  Contacts before_, now_;
  PairBatch batch_;
  PairSums sums_;
  PairEnergy energy_;
  OutsideForces outside_;
};

/// Copies of the kernel that this machine can run, the fastest first.
[[nodiscard]] const std::vector<const PairKernels*>& available_pair_kernels();

}  // namespace grainstep::dem
