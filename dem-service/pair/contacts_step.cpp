/// @file One step of all contacts: who touches, what they remember, forces, energy.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "dem-service/pair/contacts.hpp"

namespace grainstep::dem {
namespace {

double sum_of(const double (&lanes)[batch_lanes]) {
  double sum = 0.0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

/// The two components of something in the plane, loaded and stored as one; aligned like a double.
using Two [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;

Two two_at(const double* at) { return *reinterpret_cast<const Two*>(at); }

template <int D>
double squared_distance(const double* a, const double* b) {
  double sum = (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
  if constexpr (D == 3) sum += (a[2] - b[2]) * (a[2] - b[2]);
  return sum;
}

}  // namespace

void PairContacts::evaluate(const PairArrays& particles, double grown) {
  if (features_.dimension == 2) {
    features_.mixed ? find_near<2, true>(particles) : find_near<2, false>(particles);
  } else {
    features_.mixed ? find_near<3, true>(particles) : find_near<3, false>(particles);
  }
  evaluate(particles, grown, {near_.data(), near_count_});
}

void PairContacts::evaluate(const PairArrays& particles, double grown, std::span<const std::uint32_t> near) {
  const auto choose = [&]<int D>() {
    const bool equal = equal_radius_ > 0.0;
    if (features_.friction) {
      equal ? sweep<D, true, true>(particles, grown, near) : sweep<D, true, false>(particles, grown, near);
    } else {
      equal ? sweep<D, false, true>(particles, grown, near) : sweep<D, false, false>(particles, grown, near);
    }
  };
  features_.dimension == 2 ? choose.operator()<2>() : choose.operator()<3>();
  energy_.damping += sum_of(sums_.damping);
  energy_.tangential += sum_of(sums_.tangential);
  energy_.stored_normal = sum_of(sums_.stored_normal);
  energy_.stored_tangential = sum_of(sums_.stored_tangential);
  energy_.largest_overlap = *std::max_element(std::begin(sums_.largest_overlap), std::end(sums_.largest_overlap));
}

/// Without a branch: whether a pair touches cannot be foretold.
template <int D, bool Mixed>
void PairContacts::find_near(const PairArrays& particles) {
  const double* position = particles.position;
  near_.resize(pairs_.size() + 1);
  std::uint32_t* near = near_.data();
  const Pair* pairs = pairs_.data();
  const auto count = static_cast<std::uint32_t>(pairs_.size());
  const std::ptrdiff_t stride = particles.stride;
  double nearly = nearly_;
  std::size_t found = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    near[found] = k;
    const double squared = squared_distance<D>(position + stride * pairs[k].first, position + stride * pairs[k].second);
    if constexpr (Mixed) {
      const double reach = particles.radius[pairs[k].first] + particles.radius[pairs[k].second];
      nearly = reach * reach;
    }
    found += squared < nearly ? 1U : 0U;
  }
  near_count_ = found;
}

template <int D, bool Friction, bool Equal>
void PairContacts::sweep(const PairArrays& particles, double grown, std::span<const std::uint32_t> near) {
  std::swap(before_, now_);
  now_.reserve(near.size(), layout_.values);
  now_.size = 0;
  sums_ = {};
  std::size_t old = 0;
  std::size_t looked_at = 0;
  while (looked_at < near.size()) {
    const std::size_t flushed = now_.size;
    looked_at += find_touching<D, Equal>(particles, near.subspan(looked_at));
    gather<D, Friction, Equal>(particles, flushed);
    old = hand_on<D, Friction>(particles, grown, flushed, old);
    if (looked_at == near.size()) {
      while (old < before_.size) finish<D, Friction>(particles, grown, old++);
    }
    flush<D, Friction>(particles, grown, flushed);
  }
  while (old < before_.size) finish<D, Friction>(particles, grown, old++);
  now_.end(layout_.values);
}

/// Appends pairs that touch to now_, with their branch vectors in the batch, until that is full; returns how many were
/// looked at.
template <int D, bool Equal>
std::size_t PairContacts::find_touching(const PairArrays& particles, std::span<const std::uint32_t> near) {
  const double* const position = particles.position;
  const double* const radius = particles.radius;
  const std::ptrdiff_t stride = particles.stride;
  const Pair* const pairs = pairs_.data();
  std::uint32_t* const number = now_.pair.data() + now_.size;
  double(*const branch)[batch_capacity] = batch_.branch;
  double reach = equal_radius_ + equal_radius_;
  std::size_t looked_at = 0;
  int count = 0;
  while (looked_at < near.size() && count < batch_capacity) {
    const std::uint32_t k = near[looked_at++];
    const auto [i, j] = pairs[k];
    const double* a = position + stride * i;
    const double* b = position + stride * j;
    if constexpr (!Equal) reach = radius[i] + radius[j];
    double squared = 0.0;
    if constexpr (D == 2) {
      const Two apart = two_at(a) - two_at(b);
      const Two squares = apart * apart;
      branch[0][count] = apart[0];
      branch[1][count] = apart[1];
      squared = squares[0] + squares[1];
    } else {
      for (int c = 0; c < D; ++c) branch[c][count] = a[c] - b[c];
      squared = squared_distance<D>(a, b);
    }
    number[count] = k;
    count += squared < reach * reach ? 1 : 0;
  }
  batch_.count = count;
  now_.size += static_cast<std::size_t>(count);
  return looked_at;
}

/// The rest of what the kernel needs to know of the batch's pairs.
template <int D, bool Friction, bool Equal>
void PairContacts::gather(const PairArrays& particles, std::size_t first_contact) {
  const PairArrays of = particles;  // of their own: what is written could be theirs
  const Pair* const pairs = pairs_.data();
  const std::uint32_t* const number = now_.pair.data() + first_contact;
  PairBatch& batch = batch_;
  const int count = batch.count;
  double radius[2] = {equal_radius_, equal_radius_};
  for (int l = 0; l < count; ++l) {
    const auto [i, j] = pairs[number[l]];
    if constexpr (!Equal) {
      radius[0] = of.radius[i];
      radius[1] = of.radius[j];
      batch.reach[l] = radius[0] + radius[1];
      batch.effective_mass[l] = of.mass[i] * of.mass[j] / (of.mass[i] + of.mass[j]);
    }
    const double* v = of.velocity + of.stride * i;
    const double* w = of.velocity + of.stride * j;
    if constexpr (D == 2) {
      const Two rate = two_at(v) - two_at(w);
      batch.velocity[0][l] = rate[0];
      batch.velocity[1][l] = rate[1];
    } else {
      for (int c = 0; c < D; ++c) batch.velocity[c][l] = v[c] - w[c];
    }
    if constexpr (Friction) {
      const double* p = of.spin + of.stride * i;
      const double* q = of.spin + of.stride * j;
      for (int c = D == 2 ? 2 : 0; c < 3; ++c) {
        batch.rolling[D == 2 ? 0 : c][l] = radius[0] * p[c] + radius[1] * q[c];
      }
    }
  }
}

/// Gives the batch's pairs the histories that they have, and ends contacts that stand before them. `old`: the first of
/// before_ that is still to be looked at; returns the next one.
template <int D, bool Friction>
std::size_t PairContacts::hand_on(const PairArrays& particles, double grown, std::size_t first_contact,
                                  std::size_t old) {
  constexpr int values = history_layout(D, Friction).values;
  const std::uint32_t* const number = now_.pair.data() + first_contact;
  const std::uint32_t* const last = before_.pair.data();
  const std::size_t none = before_.size;  // what stands behind the last has no history
  const int count = batch_.count;
  std::size_t source[batch_capacity];
  for (int l = 0; l < count; ++l) {
    const std::uint32_t k = number[l];
    while (last[old] < k) finish<D, Friction>(particles, grown, old++);
    const bool lasting = last[old] == k;
    source[l] = lasting ? old : none;
    old += lasting ? 1 : 0;
  }
  for (int h = 0; h < values; ++h) {
    const double* const before = before_.value[h].data();
    double* const now = now_.value[h].data() + first_contact;
    for (int l = 0; l < count; ++l) now[l] = before[source[l]];
  }
  return old;
}

template <int D, bool Friction>
void PairContacts::flush(const PairArrays& particles, double grown, std::size_t first_contact) {
  constexpr HistoryLayout layout = history_layout(D, Friction);
  const int count = batch_.count;
  for (int l = count; l % batch_lanes != 0; ++l) {  // a pair that just touches, at rest: no force, no energy
    for (int c = 0; c < D; ++c) batch_.branch[c][l] = c == 0 ? (equal_radius_ > 0.0 ? batch_.reach[l] : 1.0) : 0.0;
    for (int c = 0; c < D; ++c) batch_.velocity[c][l] = batch_.rolling[c][l] = 0.0;
    for (int h = 0; h < layout.values; ++h) now_.value[h][first_contact + static_cast<std::size_t>(l)] = 0.0;
    if (equal_radius_ == 0.0) batch_.reach[l] = batch_.effective_mass[l] = 1.0;
  }
  double* history[most_history_values] = {};
  for (int h = 0; h < layout.values; ++h) history[h] = now_.value[h].data() + first_contact;
  kernel_(law_, grown, batch_, history, sums_);
  outside_.reserve(static_cast<std::size_t>(count) + 1);
  equal_radius_ > 0.0 ? add_forces<D, Friction, true>(particles, first_contact)
                      : add_forces<D, Friction, false>(particles, first_contact);
  batch_.count = 0;
}

template <int D, bool Friction, bool Equal>
void PairContacts::add_forces(const PairArrays& particles, std::size_t first_contact) {
  constexpr HistoryLayout layout = history_layout(D, Friction);
  constexpr int first_turn = D == 2 ? 2 : 0;
  const PairArrays of = particles;
  const Pair* const pairs = pairs_.data();
  const std::uint32_t* const number = now_.pair.data() + first_contact;
  const double(*const force)[batch_capacity] = batch_.force;
  const double* turning[3] = {};
  for (int c = first_turn; Friction && c < 3; ++c)
    turning[c] = now_.value[layout.torque + c - first_turn].data() + first_contact;
  double radius[2] = {equal_radius_, equal_radius_};
  double* outside = outside_.next();
  const int count = batch_.count;
  for (int l = 0; l < count; ++l) {
    const auto [i, j] = pairs[number[l]];
    if constexpr (!Equal) {
      radius[0] = of.radius[i];
      radius[1] = of.radius[j];
    }
    const bool inside = j >= of.first && j < of.last;
    double* on_first = of.force + of.force_stride * i;
    double* on_second = inside ? of.force + of.force_stride * j : outside;
    if constexpr (D == 2) {
      const Two both{force[0][l], force[1][l]};
      *reinterpret_cast<Two*>(on_first) += both;
      *reinterpret_cast<Two*>(on_second) -= both;
    } else {
      for (int c = 0; c < D; ++c) on_first[c] += force[c][l];
      for (int c = 0; c < D; ++c) on_second[c] -= force[c][l];
    }
    if constexpr (Friction) {
      double* turns_first = of.torque + of.force_stride * i;
      double* turns_second = inside ? of.torque + of.force_stride * j : outside + 3;
      for (int c = first_turn; c < 3; ++c) {
        turns_first[c] -= radius[0] * turning[c][l];
        turns_second[c] -= radius[1] * turning[c][l];
      }
    }
    if (inside) continue;
    outside_.add(j);
    outside = outside_.next();
  }
}

/// A contact that has ended: its last forces still worked through half of the interval.
template <int D, bool Friction>
void PairContacts::finish(const PairArrays& particles, double grown, std::size_t contact) {
  if (!features_.energy) return;
  constexpr HistoryLayout layout = history_layout(D, Friction);
  const auto [i, j] = pairs_[before_.pair[contact]];
  const std::ptrdiff_t a = particles.stride * i;
  const std::ptrdiff_t b = particles.stride * j;
  const double half = 0.5 * grown;
  double approach = 0.0;
  double work = 0.0;
  for (int c = 0; c < D; ++c) {
    const double apart = particles.position[a + c] - particles.position[b + c];
    const double rate = particles.velocity[a + c] - particles.velocity[b + c];
    approach += (apart - grown * rate) * rate;
    if constexpr (Friction) work += law_.tangential_stiffness * before_.value[layout.spring + c][contact] * rate;
  }
  sums_.damping[0] += half * before_.value[layout.dashpot][contact] * approach;
  if constexpr (Friction) {
    for (int c = D == 2 ? 2 : 0; c < 3; ++c) {
      const double rolling = particles.radius[i] * particles.spin[a + c] + particles.radius[j] * particles.spin[b + c];
      work += before_.value[layout.torque + (D == 2 ? 0 : c)][contact] * rolling;
    }
    sums_.tangential[0] += half * work;
  }
}

}  // namespace grainstep::dem
