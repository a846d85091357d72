/// @file The pairs of one block of grains with all others that may touch before any of them has moved further than it
/// is allowed to, and those of them that may touch soon.
///
/// A pair is in the list where the distance is at most both radii and what both may move: none that touches can be
/// missing while all keep to it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem-service/native/cells.hpp"
#include "dem-service/native/grains.hpp"

namespace grainstep::dem::native {

/// Radius and what a grain may move. Arrays have lanes_at_once more than there are grains.
struct Reach {
  std::vector<float> of;        ///< m
  float equal_and_slow = 0.0F;  ///< m, of every slow grain where sizes are equal; else 0

  template <class Archive>
  void serialize(Archive& archive) {
    archive("reach", of);
    archive("of equal and slow ones", equal_and_slow);
  }
};

template <int D>
class PairList {
 public:
  /// Pairs whose first is in [first, last); what pairs() gave before stays where it is until the next time.
  /// `fast_reach`: m, no further from a fast one is anyone who may touch it.
  void rebuild(const Sweeps& sweeps, const Grains<D>& grains, const Cells<D>& cells, const Reach& reach,
               double fast_reach, std::int32_t first, std::int32_t last);

  /// Fills the inner list from the whole one.
  void refresh(const Sweeps& sweeps, const Grains<D>& grains, const Reach& inner);

  /// Numbers of pairs of the whole list that are within both radii and `slack` (m) now, into near().
  void look(const Sweeps& sweeps, const Grains<D>& grains, float slack);

  [[nodiscard]] std::span<const Pair> pairs() const { return {pairs_.data(), static_cast<std::size_t>(count_)}; }
  [[nodiscard]] std::span<const std::uint32_t> near() const { return {near_.data(), near_count_}; }
  /// Number of the pair (i, j) in the whole list; -1 for none. i is in the block.
  [[nodiscard]] std::int32_t find(std::int32_t i, std::int32_t j) const;

  /// Both lists; what may touch now is looked for in every step.
  template <class Archive>
  void serialize(Archive& archive) {
    if constexpr (!Archive::loads) forget_room();
    archive("first grain", first_);
    archive("pairs of each", begin_of_grain_);
    archive("pairs", pairs_);
    archive("how many", count_);
    archive("of slow grains", slow_count_);
    archive("inner pairs", inner_);
    archive("their numbers", inner_number_);
    archive("how many", inner_count_);
    if constexpr (Archive::loads) require_whole();
  }

 private:
  /// Loops write ahead of what they have found; that need not be kept.
  void forget_room();
  void require_whole() const;
  void add(const Sweeps& sweeps, const Grains<D>& grains, const Reach& reach, std::int32_t grain, const Range* ranges,
           int count);

  std::vector<Pair> pairs_, before_, inner_;
  std::vector<std::uint32_t> inner_number_;  ///< of each in the whole list
  std::vector<std::uint32_t> near_;
  std::vector<std::int32_t> begin_of_grain_;
  std::int32_t first_ = 0;
  std::ptrdiff_t count_ = 0, slow_count_ = 0;
  std::size_t inner_count_ = 0, near_count_ = 0;
};

}  // namespace grainstep::dem::native
