#include "dem-service/native/grains.hpp"

#include <algorithm>
#include <utility>

namespace grainstep::dem::native {
namespace {

constexpr std::int32_t grains_at_once = 4096;

/// The first of `values` in a new order, through a copy that is kept.
template <typename T>
void rearrange(base::Team& team, std::vector<T>& values, const std::vector<std::int32_t>& order) {
  static thread_local std::vector<T> buffer;
  buffer.resize(order.size());
  std::vector<T>& copy = buffer;  // this thread's, for all
  const Blocks parts{static_cast<std::int32_t>(order.size()), grains_at_once};
  team.each(parts.count(), [&](std::int32_t part) {
    for (auto n = static_cast<std::size_t>(parts.first(part)); n < static_cast<std::size_t>(parts.last(part)); ++n) {
      copy[n] = values[static_cast<std::size_t>(order[n])];
    }
  });
  team.each(parts.count(), [&](std::int32_t part) {
    std::copy(copy.begin() + parts.first(part), copy.begin() + parts.last(part), values.begin() + parts.first(part));
  });
}

}  // namespace

template <int D>
Grains<D>::Grains(const SlugModel& model, const std::vector<PlacedParticle>& particles,
                  const std::vector<std::int32_t>& identities)
    : states_(particles.size()),
      forces_(particles.size() + 1),
      places_((particles.size() + lanes_at_once) * place_size<D>),
      identity_(identities),
      springs_(particles.size()),
      mixed_(!model.sizes.equal()) {
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const PlacedParticle& particle = particles[n];
    const double diameter = particle.diameter > 0.0 ? particle.diameter : model.diameter;
    const double mass = model.mass_of(diameter);
    const double radius = diameter / 2.0;
    radius_.push_back(radius);
    mass_.push_back(mass);
    per_mass_.push_back(1.0 / mass);
    per_inertia_.push_back(1.0 / (model.gyration() * mass * radius * radius));
    float_radius_.push_back(static_cast<float>(radius));
    largest_radius_ = std::max(largest_radius_, radius);
    const auto i = static_cast<std::ptrdiff_t>(n);
    for (std::size_t c = 0; c < D; ++c) {
      position(i)[c] = particle.position[c];
      velocity(i)[c] = particle.velocity[c];
    }
    state(i)[R::spin + 2] = particle.spin;
  }
  set_rows();
}

template <int D>
void Grains<D>::set_rows() {
  for (std::ptrdiff_t i = 0; i < count(); ++i) {
    rows_[0].push_back(state(i) + R::position);
    rows_[1].push_back(state(i) + R::velocity);
    rows_[2].push_back(state(i) + R::spin);
    rows_[3].push_back(force(i) + R::force);
    rows_[4].push_back(force(i) + R::torque);
  }
}

template <int D>
contact::ParticleArrays Grains<D>::arrays(std::int32_t owned) {
  return {.owned = owned,
          .position = rows_[0].data(),
          .velocity = rows_[1].data(),
          .spin = rows_[2].data(),
          .force = rows_[3].data(),
          .torque = rows_[4].data(),
          .radius = radius_.data(),
          .mass = mass_.data(),
          .identity = identity_.data(),
          .spring = springs_.data()};
}

template <int D>
void Grains<D>::reorder(base::Team& team, const std::vector<std::int32_t>& order) {
  rearrange(team, states_, order);
  rearrange(team, identity_, order);
  rearrange(team, springs_, order);
  if (!mixed_) return;
  rearrange(team, radius_, order);
  rearrange(team, mass_, order);
  rearrange(team, per_mass_, order);
  rearrange(team, per_inertia_, order);
  rearrange(team, float_radius_, order);
}

template <int D>
void Grains<D>::set_origin(base::Team& team, const double* origin, std::int32_t known) {
  std::copy_n(origin, D, origin_);
  remembered_.resize(places_.size());
  const Blocks parts{known, grains_at_once};
  team.each(parts.count(), [&](std::int32_t part) {
    for (std::ptrdiff_t i = parts.first(part); i < parts.last(part); ++i) {
      for (std::ptrdiff_t c = 0; c < D; ++c) {
        const auto place = static_cast<float>(position(i)[c] - origin_[c]);
        places_[static_cast<std::size_t>(i * place_size<D> + c)] = place;
        remembered_[static_cast<std::size_t>(i * place_size<D> + c)] = place;
      }
    }
  });
}

template <int D>
double Grains<D>::move(const Sweeps& sweeps, std::int32_t first, std::int32_t last, const surface::Vec3& frame,
                       double kick, double drift) {
  if (first == last) return 0.0;
  Motion motion;
  motion.rows = states_.front().value;
  motion.forces = force(0);
  motion.places = places_.data();
  motion.per_mass = per_mass_.data();
  motion.per_inertia = per_inertia_.data();
  motion.each = mixed_ ? 1 : 0;
  motion.kick = kick;
  motion.drift = drift;
  std::copy_n(frame.c.begin(), 3, motion.frame);
  std::copy_n(origin_, 3, motion.origin);
  motion.first = first;
  motion.last = last;
  return std::sqrt(sweeps.move[D - 2](motion));
}

template <int D>
double Grains<D>::displaced(const Sweeps& sweeps, std::int32_t first, std::int32_t last,
                            const surface::Vec3& shift) const {
  Displacement displacement;
  displacement.places = places_.data();
  displacement.before = remembered_.data();
  for (std::size_t c = 0; c < 3; ++c) displacement.shift[c] = static_cast<float>(shift[c]);
  displacement.first = first;
  displacement.last = last;
  return std::sqrt(static_cast<double>(sweeps.displaced[D - 2](displacement)));
}

template <int D>
void Grains<D>::kick_alone(std::ptrdiff_t i, double kick) {
  const auto n = static_cast<std::size_t>(i);
  for (int c = 0; c < D; ++c) velocity(i)[c] += kick * per_mass_[n] * force(i)[R::force + c];
  for (std::ptrdiff_t c = R::turn; c < 3; ++c) {
    state(i)[R::spin + c] += kick * per_inertia_[n] * force(i)[R::torque + c];
  }
}

template <int D>
typename Grains<D>::Speeds Grains<D>::speeds(std::ptrdiff_t i) const {
  Speeds out{};
  std::copy_n(velocity(i), 3, out.value);
  std::copy_n(spin(i), 3, out.value + 3);
  return out;
}

template <int D>
void Grains<D>::set_speeds(std::ptrdiff_t i, const Speeds& speeds) {
  std::copy_n(speeds.value + 3, 3, state(i) + R::spin);
  std::copy_n(speeds.value, 3, velocity(i));
}

template class Grains<2>;
template class Grains<3>;

}  // namespace grainstep::dem::native
