#include "dem-service/native/contacts.hpp"

#include <algorithm>
#include <stdexcept>

namespace grainstep::dem::native {

template <int D>
Contacts<D>::Contacts(const PairLaw& law, const PairFeatures& features, const Grains<D>& grains, const Blocks& most) {
  for (std::int32_t block = 0; block < most.count(); ++block) {
    blocks_.push_back({.contacts = PairContacts(law, features), .kept = {}, .kept_of = {}});
    if (!grains.mixed()) blocks_.back().contacts.set_equal(grains.radius(0), grains.mass(0));
  }
}

/// What a block's contacts have to hand on, and to which pair of which block.
template <int D>
void Contacts<D>::keep(Block& block, const Neighbours<D>& neighbours) {
  const PairContacts& contacts = block.contacts;
  const int values = contacts.values_per_contact();
  block.kept.resize(contacts.count());
  for (std::size_t n = 0; n < contacts.count(); ++n) {
    const Pair& pair = contacts.pair_of(n);
    const std::int32_t a = place_of_[static_cast<std::size_t>(pair.first)];
    const std::int32_t b = place_of_[static_cast<std::size_t>(pair.second)];
    // A pair stands in the list with one of its grains first, whichever that is.
    Kept& kept = block.kept[n];
    kept.block = neighbours.blocks().of(a);
    kept.pair = neighbours.list(kept.block).find(a, b);
    const bool straight = kept.pair >= 0;
    if (!straight) {
      kept.block = neighbours.blocks().of(b);
      kept.pair = neighbours.list(kept.block).find(b, a);
    }
    for (int h = 0; h < values; ++h) {
      kept.value[h] = (straight ? 1.0 : contacts.seen_from_second(h)) * contacts.value(n, h);
    }
  }
}

template <int D>
void Contacts<D>::follow(base::Team& team, const Neighbours<D>& neighbours, const Grains<D>& grains) {
  const std::vector<std::int32_t>& order = neighbours.order();
  const Blocks& now = neighbours.blocks();
  place_of_.resize(std::max(place_of_.size(), order.size()));
  team.each(now.count(), [&](std::int32_t block) {
    for (std::int32_t n = now.first(block); n < now.last(block); ++n) {
      place_of_[static_cast<std::size_t>(order[static_cast<std::size_t>(n)])] = n;
    }
    blocks_[static_cast<std::size_t>(block)].kept_of.assign(neighbours.list(block).pairs().size(), nullptr);
  });
  team.each(now.count(), [&](std::int32_t number) {
    Block& block = blocks_[static_cast<std::size_t>(number)];
    keep(block, neighbours);
    for (const Kept& kept : block.kept) {
      if (kept.pair < 0) continue;  // far apart since the last step: impossible but for what check_speed() tells
      blocks_[static_cast<std::size_t>(kept.block)].kept_of[static_cast<std::size_t>(kept.pair)] = &kept;
    }
  });
  team.each(now.count(), [&](std::int32_t number) {
    Block& block = blocks_[static_cast<std::size_t>(number)];
    block.contacts.clear(grains.largest_radius());
    block.contacts.set_pairs(neighbours.list(number).pairs());
    for (std::size_t k = 0; k < block.kept_of.size(); ++k) {
      if (block.kept_of[k] != nullptr) block.contacts.adopt(k, block.kept_of[k]->value);
    }
  });
}

template <int D>
void Contacts<D>::take_lists(const Neighbours<D>& neighbours, const Grains<D>& grains) {
  const std::int32_t now = neighbours.blocks().count();
  if (now < 0 || static_cast<std::size_t>(now) > blocks_.size()) throw std::range_error("another number of blocks");
  for (std::int32_t number = 0; number < now; ++number) {
    PairContacts& contacts = blocks_[static_cast<std::size_t>(number)].contacts;
    contacts.clear(grains.largest_radius());
    contacts.set_pairs(neighbours.list(number).pairs());
  }
}

template <int D>
void Contacts<D>::evaluate(base::Team& team, Grains<D>& grains, Neighbours<D>& neighbours, double grown) {
  const Blocks& now = neighbours.blocks();
  team.each(now.count(), [&](std::int32_t number) {
    neighbours.look(number, grains);
    PairArrays arrays = grains.pair_arrays();
    arrays.first = now.first(number);
    arrays.last = now.last(number);
    blocks_[static_cast<std::size_t>(number)].contacts.evaluate(arrays, grown, neighbours.list(number).near());
  });
  using R = Row<D>;
  for (std::int32_t number = 0; number < now.count(); ++number) {
    blocks_[static_cast<std::size_t>(number)].contacts.outside().take([&](std::int32_t grain, const double* forces) {
      double* row = grains.force(grain);
      for (int c = 0; c < D; ++c) row[R::force + c] += forces[c];
      for (std::ptrdiff_t c = R::turn; c < 3; ++c) row[R::torque + c] += forces[3 + c];
    });
  }
}

template <int D>
PairEnergy Contacts<D>::energy() const {
  PairEnergy sum = blocks_.front().contacts.energy();
  for (std::size_t n = 1; n < blocks_.size(); ++n) sum += blocks_[n].contacts.energy();
  return sum;
}

template <int D>
std::vector<Pair> Contacts<D>::touching() const {
  std::vector<Pair> all;
  for (const Block& block : blocks_) {
    for (std::size_t n = 0; n < block.contacts.count(); ++n) all.push_back(block.contacts.pair_of(n));
  }
  return all;
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace grainstep::dem::native
