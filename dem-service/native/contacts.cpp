#include "dem-service/native/contacts.hpp"

#include <algorithm>

namespace grainstep::dem::native {

template <int D>
Contacts<D>::Contacts(const PairLaw& law, const PairFeatures& features, const Sweeps& sweeps, const Grains<D>& grains)
    : sweeps_(sweeps), contacts_(law, features) {
  if (!grains.mixed()) contacts_.set_equal(grains.radius(0), grains.mass(0));
}

template <int D>
void Contacts<D>::follow(Neighbours<D>& neighbours, const Grains<D>& grains) {
  const std::vector<std::int32_t>& order = neighbours.order();
  place_of_.resize(std::max(place_of_.size(), order.size()));
  for (std::size_t n = 0; n < order.size(); ++n) {
    place_of_[static_cast<std::size_t>(order[n])] = static_cast<std::int32_t>(n);
  }
  kept_.clear();
  kept_of_.assign(neighbours.count(), -1);
  const int values = contacts_.values_per_contact();
  for (std::size_t n = 0; n < contacts_.count(); ++n) {
    const Pair& pair = contacts_.pair_of(n);
    const std::int32_t a = place_of_[static_cast<std::size_t>(pair.first)];
    const std::int32_t b = place_of_[static_cast<std::size_t>(pair.second)];
    // A pair stands in the list with one of its grains first, whichever that is.
    const std::int32_t straight = neighbours.find(a, b);
    const std::int32_t k = straight >= 0 ? straight : neighbours.find(b, a);
    if (k < 0) continue;  // far apart since the last step: impossible but for what check_speed() tells
    kept_of_[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(kept_.size());
    Kept& kept = kept_.emplace_back();
    for (int h = 0; h < values; ++h) {
      kept.value[h] = (straight >= 0 ? 1.0 : contacts_.seen_from_second(h)) * contacts_.value(n, h);
    }
  }
  contacts_.clear(grains.largest_radius());
  neighbours.give_pairs(contacts_);
  for (std::size_t k = 0; k < kept_of_.size(); ++k) {
    if (kept_of_[k] >= 0) contacts_.adopt(k, kept_[static_cast<std::size_t>(kept_of_[k])].value);
  }
}

template <int D>
void Contacts<D>::evaluate(Grains<D>& grains, const Neighbours<D>& neighbours, double grown) {
  const InnerList& inner = neighbours.inner();
  near_.resize(std::max(near_.size(), inner.pair.size() + lanes_at_once));
  const auto reach = static_cast<float>(2.0 * grains.largest_radius());
  const std::ptrdiff_t count = sweeps_.touching[D - 2](
      {grains.places(), inner.pair.data(), inner.number.data(), static_cast<std::ptrdiff_t>(inner.count), reach,
       grains.mixed() ? grains.radii() : nullptr, 2.0F * neighbours.slack()},
      near_.data());
  contacts_.evaluate(grains.pair_arrays(), grown, {near_.data(), static_cast<std::size_t>(count)});
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace grainstep::dem::native
