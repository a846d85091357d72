/// @file Pairs of grains that may touch before any of them has moved further than it is allowed to.
///
/// Speeds are judged in a frame that moves with the grains. Most of them are slow in it and may move little; those that
/// are fast may move more, so that a few of them do not make the list old for all. A pair is in the list where the
/// distance is at most both radii and what both may move: none that touches can be missing while all keep to it.
#pragma once

#include <cstdint>
#include <vector>

#include "dem-service/native/grains.hpp"
#include "dem-service/pair/contacts.hpp"

namespace grainstep::dem::native {

/// m, in the frame, until a list is made anew.
struct Allowance {
  double slow = 0.0;
  double fast = 0.0;
  /// Not for what is not a number.
  [[nodiscard]] bool within(const Allowance& other) const { return slow <= other.slow && fast <= other.fast; }
};

/// Those pairs of the whole list that may touch soon.
struct InnerList {
  std::vector<Pair> pair;
  std::vector<std::uint32_t> number;  ///< of each in the whole list
  std::size_t count = 0;
};

template <int D>
class Neighbours {
 public:
  /// `inner`: what grains may move until refresh().
  Neighbours(const Sweeps& sweeps, const Allowance& allowance, const Allowance& inner)
      : sweeps_(sweeps), allowance_(allowance), inner_allowance_(inner) {}

  /// Sorts the first `active` grains: slow ones, cell by cell, then fast ones. `fast[i]`: which they are. Fills the
  /// list and order(), which says for every place where its grain stood before.
  void rebuild(Grains<D>& grains, std::int32_t active, const std::vector<std::uint8_t>& fast);

  /// Fills the inner list from the whole one.
  void refresh(const Grains<D>& grains);

  [[nodiscard]] const std::vector<std::int32_t>& order() const { return order_; }
  [[nodiscard]] std::int32_t slow() const { return slow_; }  ///< how many
  [[nodiscard]] const InnerList& inner() const { return inner_; }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(count_); }
  /// The whole list, for find() and refresh() as well.
  void give_pairs(PairContacts& contacts) const {
    contacts.set_pairs({pairs_.data(), static_cast<std::size_t>(count_)});
  }
  /// Number of the pair (i, j) in the whole list; -1 for none.
  [[nodiscard]] std::int32_t find(std::int32_t i, std::int32_t j) const;
  [[nodiscard]] float slack() const { return slack_; }  ///< m, round-off of places

 private:
  struct Cells {
    std::int32_t number[3] = {1, 1, 1};
    double low[3] = {0.0, 0.0, 0.0};
    double per_size = 0.0;
    [[nodiscard]] std::int32_t count() const { return number[0] * number[1] * number[2]; }
  };

  void lay_cells(const Grains<D>& grains, std::int32_t active);
  void sort(Grains<D>& grains, std::int32_t active, const std::vector<std::uint8_t>& fast);
  void find_slow(const Grains<D>& grains);
  void find_fast(const Grains<D>& grains, std::int32_t active);
  void look(const Grains<D>& grains, std::int32_t grain, std::int32_t first, std::int32_t last);
  [[nodiscard]] std::int32_t begin_of(const std::vector<std::int32_t>& begin, int x, int y, int z) const;

  const Sweeps& sweeps_;
  Allowance allowance_, inner_allowance_;
  Cells cells_;
  std::vector<std::int32_t> cell_of_, order_, slow_begin_, fast_begin_;
  std::vector<float> reach_, inner_reach_;
  std::vector<Pair> pairs_;
  std::vector<std::int32_t> begin_of_grain_;
  InnerList inner_;
  std::ptrdiff_t count_ = 0;
  std::int32_t slow_ = 0;
  float slack_ = 0.0F;
};

}  // namespace grainstep::dem::native
