/// @file Contacts between grains: those of PairContacts, one for each block, whose histories follow the grains when
/// these are put in another order.
#pragma once

#include <cstdint>
#include <vector>

#include "dem-service/native/neighbours.hpp"
#include "dem-service/pair/contacts.hpp"

namespace grainstep::dem::native {

template <int D>
class Contacts {
 public:
  Contacts(const PairLaw& law, const PairFeatures& features, const Grains<D>& grains, const Blocks& most);

  /// The lists are new ones, and order[n] says where the grain that stands at n stood before: histories move along.
  void follow(base::Team& team, const Neighbours<D>& neighbours, const Grains<D>& grains);

  /// Adds forces and torques. `grown`: s since the last step; 0 at the start.
  void evaluate(base::Team& team, Grains<D>& grains, Neighbours<D>& neighbours, double grown);

  [[nodiscard]] PairEnergy energy() const;

  /// Read back once `neighbours` and `grains` have been.
  template <class Archive>
  void serialize(Archive& archive, const Neighbours<D>& neighbours, const Grains<D>& grains) {
    if constexpr (Archive::loads) take_lists(neighbours, grains);
    for (Block& block : blocks_) archive("contacts of a block", block.contacts);
  }

  /// The pairs that touch, for tests.
  [[nodiscard]] std::vector<Pair> touching() const;

 private:
  struct Kept {
    std::int32_t pair;  ///< in the list of its block; -1: nobody looks after it any more
    std::int32_t block;
    double value[most_history_values];
  };
  struct Block {
    PairContacts contacts;
    std::vector<Kept> kept;            ///< of the contacts that were this block's, for whoever has them now
    std::vector<const Kept*> kept_of;  ///< of each pair of the new list; nullptr: it did not touch
  };

  void take_lists(const Neighbours<D>& neighbours, const Grains<D>& grains);
  void keep(Block& block, const Neighbours<D>& neighbours);

  std::vector<Block> blocks_;
  std::vector<std::int32_t> place_of_;
};

}  // namespace grainstep::dem::native
