#include "dem-service/native/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grainstep::dem::native {
namespace {

double sum_of(const double (&lanes)[batch_lanes]) {
  double sum = 0.0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

}  // namespace

template <int D>
Contacts<D>::Contacts(const PairLaw& law, const PairFeatures& features, const Sweeps& sweeps, const Grains<D>& grains)
    : law_(law),
      features_(features),
      layout_(history_layout(features.dimension, features.friction)),
      kernel_(available_pair_kernels().front()->of(features)),
      sweeps_(sweeps) {
  if (grains.count() == 0) return;
  for (int l = 0; l < batch_capacity; ++l) {  // of equal grains once and for all
    batch_.reach[l] = 2.0 * grains.radius(0);
    batch_.mass_product[l] = grains.mass(0) * grains.mass(0);
    batch_.mass_sum[l] = 2.0 * grains.mass(0);
  }
}

template <int D>
void Contacts<D>::follow(const Neighbours<D>& neighbours) {
  const std::vector<std::int32_t>& order = neighbours.order();
  place_of_.resize(std::max(place_of_.size(), order.size()));
  for (std::size_t n = 0; n < order.size(); ++n) place_of_[static_cast<std::size_t>(order[n])] = static_cast<int>(n);

  kept_.clear();
  for (const Touch& touch : now_) kept_.push_back(history_[static_cast<std::size_t>(touch.pair)]);
  const PairList pairs = neighbours.pairs();
  const auto count = static_cast<std::size_t>(pairs.count);
  if (history_.size() < count) {
    history_.resize(count + count / 2);
    stamp_.resize(count + count / 2);
  }
  std::fill(stamp_.begin(), stamp_.end(), 0U);
  for (std::size_t n = 0; n < now_.size(); ++n) {
    Touch& touch = now_[n];
    const std::int32_t a = place_of_[static_cast<std::size_t>(touch.first)];
    const std::int32_t b = place_of_[static_cast<std::size_t>(touch.second)];
    // Pairs of one grain stand together; which of the two a pair is listed with is the list's affair.
    const std::int32_t* const end = pairs.first + pairs.count;
    const auto find = [&](std::int32_t i, std::int32_t j) {
      const std::int32_t* at = std::lower_bound(pairs.first, end, i);
      while (at != end && *at == i && pairs.second[at - pairs.first] != j) ++at;
      return at != end && *at == i ? at - pairs.first : std::ptrdiff_t{-1};
    };
    std::ptrdiff_t k = find(a, b);
    const bool turned = k < 0;
    if (turned) k = find(b, a);
    if (turned) {
      for (int h = layout_.spring; layout_.values > 1 && h < layout_.torque; ++h) kept_[n].value[h] *= -1.0;
    }
    touch = turned ? Touch{static_cast<std::int32_t>(k), b, a} : Touch{static_cast<std::int32_t>(k), a, b};
    if (k < 0) continue;  // parted since: it has ended
    history_[static_cast<std::size_t>(k)] = kept_[n];
    stamp_[static_cast<std::size_t>(k)] = evaluation_;
  }
  // A contact that is not listed any more has ended: evaluate() books its last half step from the same rows.
  std::size_t spare = count;
  for (std::size_t n = 0; n < now_.size(); ++n) {
    if (now_[n].pair >= 0) continue;
    if (history_.size() <= spare) {
      history_.resize(spare + 64);
      stamp_.resize(spare + 64);
    }
    history_[spare] = kept_[n];
    now_[n].pair = static_cast<std::int32_t>(spare++);
  }
}

template <int D>
void Contacts<D>::evaluate(Grains<D>& grains, const Neighbours<D>& neighbours, double grown) {
  const PairList pairs = neighbours.pairs();
  found_.resize(std::max(found_.size(), static_cast<std::size_t>(pairs.count) + 1));
  const auto reach = static_cast<float>(2.0 * grains.largest_radius());
  const std::ptrdiff_t near = sweeps_.touching[D - 2](grains.places(), pairs, reach,
                                                      grains.mixed() ? grains.radii() : nullptr,
                                                      2.0F * neighbours.slack(), found_.data());
  std::swap(before_, now_);
  now_.clear();
  sums_ = {};
  batch_.count = 0;
  for (std::ptrdiff_t n = 0; n < near; ++n) {
    const std::int32_t k = found_[static_cast<std::size_t>(n)];
    now_.push_back({k, pairs.first[k], pairs.second[k]});
  }
  features_.friction ? sweep<true>(grains, pairs, grown) : sweep<false>(grains, pairs, grown);
  note_sums();
}

template <int D>
void Contacts<D>::note_sums() {
  energy_.damping += sum_of(sums_.damping);
  energy_.tangential += sum_of(sums_.tangential);
  energy_.stored_normal = sum_of(sums_.stored_normal);
  energy_.stored_tangential = sum_of(sums_.stored_tangential);
  energy_.largest_overlap = *std::max_element(std::begin(sums_.largest_overlap), std::end(sums_.largest_overlap));
}

template <int D>
template <bool Friction>
void Contacts<D>::sweep(Grains<D>& grains, const PairList& /*pairs*/, double grown) {
  constexpr int values = history_layout(D, Friction).values;
  const std::uint32_t last = evaluation_++;
  std::size_t size = 0;
  std::size_t flushed = 0;
  for (const Touch touch : now_) {
    const double* a = grains.position(touch.first);
    const double* b = grains.position(touch.second);
    double branch[D];
    double squared = 0.0;
    for (int c = 0; c < D; ++c) branch[c] = a[c] - b[c];
    for (int c = 0; c < D; ++c) squared += branch[c] * branch[c];
    const double reach = grains.radius(touch.first) + grains.radius(touch.second);
    if (!(squared < reach * reach)) continue;
    now_[size++] = touch;
    const int l = batch_.count++;
    const auto k = static_cast<std::size_t>(touch.pair);
    const double* v = grains.velocity(touch.first);
    const double* w = grains.velocity(touch.second);
    for (int c = 0; c < D; ++c) batch_.branch[c][l] = branch[c];
    for (int c = 0; c < D; ++c) batch_.velocity[c][l] = v[c] - w[c];
    if constexpr (Friction) {
      const double* p = grains.spin(touch.first);
      const double* q = grains.spin(touch.second);
      for (int c = static_cast<int>(R::turn); c < 3; ++c) {
        batch_.rolling[c - R::turn][l] = grains.radius(touch.first) * p[c] + grains.radius(touch.second) * q[c];
      }
    }
    const bool lasting = stamp_[k] == last;
    for (int h = 0; h < values; ++h) batch_history_[h][l] = lasting ? history_[k].value[h] : 0.0;
    if (features_.mixed) {
      batch_.reach[l] = reach;
      batch_.mass_product[l] = grains.mass(touch.first) * grains.mass(touch.second);
      batch_.mass_sum[l] = grains.mass(touch.first) + grains.mass(touch.second);
    }
    if (batch_.count == batch_capacity) {
      flush<Friction>(grains, flushed, grown);
      flushed = size;
    }
  }
  flush<Friction>(grains, flushed, grown);
  now_.resize(size);
  if (!features_.energy) return;
  for (const Touch& touch : before_) {
    if (stamp_[static_cast<std::size_t>(touch.pair)] != evaluation_) finish<Friction>(grains, touch, grown);
  }
}

template <int D>
template <bool Friction>
void Contacts<D>::flush(Grains<D>& grains, std::size_t first, double grown) {
  constexpr HistoryLayout layout = history_layout(D, Friction);
  const int count = batch_.count;
  for (int l = count; l % batch_lanes != 0; ++l) {  // a pair that just touches, at rest: no force, no energy
    for (int c = 0; c < D; ++c) batch_.branch[c][l] = c == 0 ? batch_.reach[l] : 0.0;
    for (int c = 0; c < D; ++c) batch_.velocity[c][l] = batch_.rolling[c][l] = 0.0;
    for (int h = 0; h < layout.values; ++h) batch_history_[h][l] = 0.0;
  }
  double* history[most_history_values] = {};
  for (int h = 0; h < layout.values; ++h) history[h] = batch_history_[h];
  kernel_(law_, grown, batch_, history, sums_);
  for (int l = 0; l < count; ++l) {
    const Touch& touch = now_[first + static_cast<std::size_t>(l)];
    const auto k = static_cast<std::size_t>(touch.pair);
    for (int h = 0; h < layout.values; ++h) history_[k].value[h] = batch_history_[h][l];
    stamp_[k] = evaluation_;
    double* on_first = grains.force(touch.first);
    double* on_second = grains.force(touch.second);
    for (int c = 0; c < D; ++c) on_first[R::force + c] += batch_.force[c][l];
    for (int c = 0; c < D; ++c) on_second[R::force + c] -= batch_.force[c][l];
    if constexpr (Friction) {
      for (std::ptrdiff_t c = R::turn; c < 3; ++c) {
        const double torque = batch_history_[layout.torque + (c - R::turn)][l];
        on_first[R::torque + c] -= grains.radius(touch.first) * torque;
        on_second[R::torque + c] -= grains.radius(touch.second) * torque;
      }
    }
  }
  batch_.count = 0;
}

/// A contact that has ended: its last forces still worked through half of the interval.
template <int D>
template <bool Friction>
void Contacts<D>::finish(const Grains<D>& grains, const Touch& touch, double grown) {
  constexpr HistoryLayout layout = history_layout(D, Friction);
  const History& last = history_[static_cast<std::size_t>(touch.pair)];
  const double half = 0.5 * grown;
  double approach = 0.0;
  double work = 0.0;
  for (int c = 0; c < D; ++c) {
    const double apart = grains.position(touch.first)[c] - grains.position(touch.second)[c];
    const double rate = grains.velocity(touch.first)[c] - grains.velocity(touch.second)[c];
    approach += (apart - grown * rate) * rate;
    if constexpr (Friction) work += law_.tangential_stiffness * last.value[layout.spring + c] * rate;
  }
  sums_.damping[0] += half * last.value[layout.dashpot] * approach;
  if constexpr (Friction) {
    for (std::ptrdiff_t c = R::turn; c < 3; ++c) {
      const double rolling = grains.radius(touch.first) * grains.spin(touch.first)[c] +
                             grains.radius(touch.second) * grains.spin(touch.second)[c];
      work += last.value[layout.torque + (c - R::turn)] * rolling;
    }
    sums_.tangential[0] += half * work;
  }
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace grainstep::dem::native
