#include "dem-service/native/pair_list.hpp"

#include <stdexcept>

namespace grainstep::dem::native {

template <int D>
void PairList<D>::add(const Sweeps& sweeps, const Grains<D>& grains, const Reach& reach, std::int32_t grain,
                      const Range* ranges, int count) {
  std::size_t room = static_cast<std::size_t>(count_) + lanes_at_once;
  for (int r = 0; r < count; ++r) room += static_cast<std::size_t>(std::max(ranges[r].last - ranges[r].first, 0));
  if (pairs_.size() < room) pairs_.resize(2 * room);
  count_ += sweeps.near[D - 2]({grains.places(), reach.of.data(), grain, ranges, count}, pairs_.data() + count_);
}

template <int D>
void PairList<D>::rebuild(const Sweeps& sweeps, const Grains<D>& grains, const Cells<D>& cells, const Reach& reach,
                          double fast_reach, std::int32_t first, std::int32_t last) {
  pairs_.swap(before_);
  count_ = 0;
  first_ = first;
  begin_of_grain_.resize(static_cast<std::size_t>(last - first) + 1);
  const auto begin = [&](std::int32_t i) {
    begin_of_grain_[static_cast<std::size_t>(i - first)] = static_cast<std::int32_t>(count_);
  };
  cells.each_slow(first, last, [&](std::int32_t i, const Range* ranges, int count) {
    begin(i);
    add(sweeps, grains, reach, i, ranges, count);
  });
  slow_count_ = count_;
  for (std::int32_t i = std::max(first, cells.slow()); i < last; ++i) {
    begin(i);
    cells.around_fast(grains, i, fast_reach,
                      [&](const Range* ranges, int count) { add(sweeps, grains, reach, i, ranges, count); });
  }
  begin(last);
}

template <int D>
void PairList<D>::refresh(const Sweeps& sweeps, const Grains<D>& grains, const Reach& inner) {
  const auto room = static_cast<std::size_t>(count_) + lanes_at_once;
  if (inner_number_.size() < room) {
    inner_number_.resize(room + room / 2);
    inner_.resize(room + room / 2);
  }
  PairSearch search{.places = grains.places(), .pairs = pairs_.data(), .last = count_, .radii = inner.of.data()};
  std::ptrdiff_t found = 0;
  if (inner.equal_and_slow > 0.0F) {
    found = sweeps.touching[D - 2](
        {.places = grains.places(), .pairs = pairs_.data(), .last = slow_count_, .reach = 2.0F * inner.equal_and_slow},
        inner_number_.data());
    search.first = slow_count_;
  }
  found += sweeps.touching[D - 2](search, inner_number_.data() + found);
  inner_count_ = static_cast<std::size_t>(found);
  for (std::size_t n = 0; n < inner_count_; ++n) inner_[n] = pairs_[inner_number_[n]];
}

template <int D>
void PairList<D>::look(const Sweeps& sweeps, const Grains<D>& grains, float slack) {
  const std::size_t room = inner_count_ + lanes_at_once;
  if (near_.size() < room) near_.resize(room + room / 2);
  near_count_ =
      static_cast<std::size_t>(sweeps.touching[D - 2]({.places = grains.places(),
                                                       .pairs = inner_.data(),
                                                       .numbers = inner_number_.data(),
                                                       .last = static_cast<std::ptrdiff_t>(inner_count_),
                                                       .reach = static_cast<float>(2.0 * grains.largest_radius()),
                                                       .radii = grains.mixed() ? grains.radii() : nullptr,
                                                       .slack = slack},
                                                      near_.data()));
}

template <int D>
void PairList<D>::forget_room() {
  pairs_.resize(static_cast<std::size_t>(count_) + lanes_at_once);
  inner_.resize(inner_count_ + lanes_at_once);
  inner_number_.resize(inner_count_ + lanes_at_once);
}

template <int D>
void PairList<D>::require_whole() const {
  const bool whole = count_ >= 0 && slow_count_ >= 0 && slow_count_ <= count_ &&
                     pairs_.size() == static_cast<std::size_t>(count_) + lanes_at_once &&
                     inner_.size() == inner_count_ + lanes_at_once && inner_number_.size() == inner_.size();
  if (!whole) throw std::range_error("a list of pairs of another length");
}

template <int D>
std::int32_t PairList<D>::find(std::int32_t i, std::int32_t j) const {
  const auto at = static_cast<std::size_t>(i - first_);
  for (std::int32_t k = begin_of_grain_[at]; k < begin_of_grain_[at + 1]; ++k) {
    if (pairs_[static_cast<std::size_t>(k)].second == j) return k;
  }
  return -1;
}

template class PairList<2>;
template class PairList<3>;

}  // namespace grainstep::dem::native
