#include "dem-service/native/neighbours.hpp"

namespace grainstep::dem::native {

template <int D>
void Neighbours<D>::set_reach(base::Team& team, const Grains<D>& grains) {
  const float slack = cells_.slack();
  const std::size_t room = static_cast<std::size_t>(blocks_.grains) + lanes_at_once;
  reach_.of.resize(room);
  inner_reach_.of.resize(room);
  team.each(blocks_.count(), [&](std::int32_t block) {
    for (std::int32_t i = blocks_.first(block); i < blocks_.last(block); ++i) {
      const auto n = static_cast<std::size_t>(i);
      const bool slow = i < cells_.slow();
      const double inner = slow ? inner_allowance_.slow : inner_allowance_.fast;
      reach_.of[n] = static_cast<float>(grains.radius(i) + (slow ? allowance_.slow : allowance_.fast)) + 2.0F * slack;
      inner_reach_.of[n] = static_cast<float>(grains.radius(i) + inner) + slack;
    }
  });
  inner_reach_.equal_and_slow = grains.mixed() || cells_.slow() == 0 ? 0.0F : inner_reach_.of.front();
}

template <int D>
void Neighbours<D>::rebuild(base::Team& team, Grains<D>& grains, const Blocks& blocks,
                            const std::vector<std::uint8_t>& fast) {
  blocks_ = blocks;
  lists_.resize(static_cast<std::size_t>(blocks.count()));
  cells_.sort(team, grains, blocks.grains, fast, 2.0 * (grains.largest_radius() + allowance_.slow));
  set_reach(team, grains);
  const double fast_reach = 2.0 * (grains.largest_radius() + allowance_.fast + 2.0 * cells_.slack());
  team.each(blocks.count(), [&](std::int32_t block) {
    PairList<D>& list = lists_[static_cast<std::size_t>(block)];
    list.rebuild(sweeps_, grains, cells_, reach_, fast_reach, blocks.first(block), blocks.last(block));
    list.refresh(sweeps_, grains, inner_reach_);
  });
}

template <int D>
void Neighbours<D>::refresh(base::Team& team, const Grains<D>& grains) {
  team.each(blocks_.count(), [&](std::int32_t block) {
    lists_[static_cast<std::size_t>(block)].refresh(sweeps_, grains, inner_reach_);
  });
}

template class Neighbours<2>;
template class Neighbours<3>;

}  // namespace grainstep::dem::native
