/// @file Grains that may touch before any of them has moved further than it is allowed to, block by block.
///
/// Speeds are judged in a frame that moves with the grains. Most of them are slow in it and may move little; those that
/// are fast may move more, so that a few of them do not make the list old for all.
#pragma once

#include <cstdint>
#include <vector>

#include "dem-service/native/blocks.hpp"
#include "dem-service/native/pair_list.hpp"

namespace grainstep::dem::native {

/// m, in the frame, until a list is made anew.
struct Allowance {
  double slow = 0.0;
  double fast = 0.0;
  /// Not for what is not a number.
  [[nodiscard]] bool within(const Allowance& other) const { return slow <= other.slow && fast <= other.fast; }
};

template <int D>
class Neighbours {
 public:
  /// `inner`: what grains may move until refresh().
  Neighbours(const Sweeps& sweeps, const Allowance& allowance, const Allowance& inner)
      : sweeps_(sweeps), allowance_(allowance), inner_allowance_(inner) {}

  /// Sorts the blocks' grains (Cells) and fills the lists.
  void rebuild(base::Team& team, Grains<D>& grains, const Blocks& blocks, const std::vector<std::uint8_t>& fast);

  /// Fills the inner lists from the whole ones.
  void refresh(base::Team& team, const Grains<D>& grains);

  /// Fills near() of one block.
  void look(std::int32_t block, const Grains<D>& grains) {
    lists_[static_cast<std::size_t>(block)].look(sweeps_, grains, 2.0F * cells_.slack());
  }

  [[nodiscard]] const std::vector<std::int32_t>& order() const { return cells_.order(); }
  [[nodiscard]] std::int32_t slow() const { return cells_.slow(); }  ///< how many
  [[nodiscard]] const Blocks& blocks() const { return blocks_; }
  [[nodiscard]] const PairList<D>& list(std::int32_t block) const { return lists_[static_cast<std::size_t>(block)]; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("blocks", blocks_);
    archive("cells", cells_);
    archive("reach", reach_);
    archive("inner reach", inner_reach_);
    archive("lists", lists_);
  }

 private:
  void set_reach(base::Team& team, const Grains<D>& grains);

  const Sweeps& sweeps_;
  Allowance allowance_, inner_allowance_;
  Blocks blocks_;
  Cells<D> cells_;
  Reach reach_, inner_reach_;
  std::vector<PairList<D>> lists_;
};

}  // namespace grainstep::dem::native
