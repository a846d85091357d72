/// @file Contacts between grains: those of PairContacts, whose histories follow the grains when these are put in
/// another order.
#pragma once

#include <cstdint>
#include <vector>

#include "dem-service/native/neighbours.hpp"
#include "dem-service/pair/contacts.hpp"

namespace grainstep::dem::native {

template <int D>
class Contacts {
 public:
  Contacts(const PairLaw& law, const PairFeatures& features, const Sweeps& sweeps, const Grains<D>& grains);

  /// The list is a new one, and order[n] says where the grain that stands at n stood before: histories move along.
  void follow(Neighbours<D>& neighbours, const Grains<D>& grains);

  /// Adds forces and torques. `grown`: s since the last step; 0 at the start.
  void evaluate(Grains<D>& grains, const Neighbours<D>& neighbours, double grown);

  [[nodiscard]] const PairEnergy& energy() const { return contacts_.energy(); }
  [[nodiscard]] const PairContacts& all() const { return contacts_; }

 private:
  struct Kept {
    double value[most_history_values];
  };

  const Sweeps& sweeps_;
  PairContacts contacts_;
  std::vector<std::uint32_t> near_;
  std::vector<std::int32_t> place_of_;
  std::vector<Kept> kept_;
  std::vector<std::int32_t> kept_of_;  ///< of each pair of the new list; -1: it did not touch
};

}  // namespace grainstep::dem::native
