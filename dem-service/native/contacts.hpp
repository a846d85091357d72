/// @file All contacts between grains: which of the listed pairs touch, their forces, history and energy. The law is that
/// of dem-service/pair/law.hpp, in the copies of its kernel.
///
/// What a contact hands on stands in a row of its own beside the list, with the number of the step that wrote it: a row
/// of another step than the last is none.
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
  void follow(const Neighbours<D>& neighbours);

  /// Adds forces and torques. `grown`: s since the last step; 0 at the start.
  void evaluate(Grains<D>& grains, const Neighbours<D>& neighbours, double grown);

  [[nodiscard]] const PairEnergy& energy() const { return energy_; }

  /// Grains that touch, in the order in which their forces were summed.
  struct Touch {
    std::int32_t pair, first, second;
  };
  [[nodiscard]] const std::vector<Touch>& touching() const { return now_; }

 private:
  using R = Row<D>;
  static constexpr int history_size = D == 2 ? 4 : 8;
  struct alignas(8 * history_size) History {
    double value[history_size];
  };

  template <bool Friction>
  void sweep(Grains<D>& grains, const PairList& pairs, double grown);
  template <bool Friction>
  void flush(Grains<D>& grains, std::size_t first, double grown);
  template <bool Friction>
  void finish(const Grains<D>& grains, const Touch& touch, double grown);
  void note_sums();

  PairLaw law_;
  PairFeatures features_;
  HistoryLayout layout_;
  PairKernel kernel_;
  const Sweeps& sweeps_;
  std::vector<std::int32_t> found_;
  std::vector<Touch> before_, now_;
  std::vector<History> history_;         ///< of every pair
  std::vector<std::uint32_t> stamp_;     ///< of every pair: the evaluation that wrote its history
  std::uint32_t evaluation_ = 1;
  PairBatch batch_;
  alignas(64) double batch_history_[most_history_values][batch_capacity];
  PairSums sums_;
  PairEnergy energy_;
  // For follow(): where each grain stands now, and the contacts of each.
  std::vector<std::int32_t> place_of_;
  std::vector<History> kept_;
};

}  // namespace grainstep::dem::native
