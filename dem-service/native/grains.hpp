/// @file All grains of one slug and how they move. Their order in memory is that of space, for speed.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/particle_arrays.hpp"
#include "dem-service/native/blocks.hpp"
#include "dem-service/native/rows.hpp"
#include "dem-service/native/sweeps.hpp"
#include "dem-service/pair/contacts.hpp"
#include "dem-service/slug/layout.hpp"

namespace grainstep::dem::native {

template <int D>
class Grains {
 public:
  using R = Row<D>;

  /// In the order given.
  Grains(const SlugModel& model, const std::vector<PlacedParticle>& particles,
         const std::vector<std::int32_t>& identities);

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(radius_.size()); }

  [[nodiscard]] double* position(std::ptrdiff_t i) { return state(i) + R::position; }
  [[nodiscard]] const double* position(std::ptrdiff_t i) const { return state(i) + R::position; }
  [[nodiscard]] double* velocity(std::ptrdiff_t i) { return state(i) + R::velocity; }
  [[nodiscard]] const double* velocity(std::ptrdiff_t i) const { return state(i) + R::velocity; }
  [[nodiscard]] const double* spin(std::ptrdiff_t i) const { return state(i) + R::spin; }
  [[nodiscard]] double* force(std::ptrdiff_t i) { return forces_[static_cast<std::size_t>(i + 1)].value; }
  [[nodiscard]] double radius(std::ptrdiff_t i) const { return radius_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double mass(std::ptrdiff_t i) const { return mass_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const float* places() const { return places_.data(); }
  [[nodiscard]] const float* radii() const { return float_radius_.data(); }
  [[nodiscard]] bool mixed() const { return mixed_; }
  [[nodiscard]] double largest_radius() const { return largest_radius_; }

  /// The first `owned` of them.
  [[nodiscard]] contact::ParticleArrays arrays(std::int32_t owned);

  [[nodiscard]] PairArrays pair_arrays() {
    return {.position = position(0),
            .velocity = velocity(0),
            .spin = spin(0),
            .force = force(0) + R::force,
            .torque = force(0) + R::torque,
            .radius = radius_.data(),
            .mass = mass_.data(),
            .stride = R::size,
            .force_stride = R::force_size};
  }

  /// What stood at order[n] stands at n, for the first order.size() of them. Forces must be zero there.
  void reorder(base::Team& team, const std::vector<std::int32_t>& order);

  /// Places are counted from here on; those of the first `known` are brought up to date, and kept to be compared with.
  void set_origin(base::Team& team, const double* origin, std::int32_t known);

  /// Kick and drift of [first, last); returns a bound on their speed against `frame`, m/s.
  double move(const Sweeps& sweeps, std::int32_t first, std::int32_t last, const surface::Vec3& frame, double kick,
              double drift);

  /// m, the largest way of [first, last) since set_origin() in a frame that has moved by `shift` (m).
  [[nodiscard]] double displaced(const Sweeps& sweeps, std::int32_t first, std::int32_t last,
                                 const surface::Vec3& shift) const;

  /// Adds the force's share of `kick` seconds to velocity and spin, and leaves the force.
  void kick_alone(std::ptrdiff_t i, double kick);

  /// Velocity and spin of one grain, to be put back.
  struct Speeds {
    double value[6];
  };
  [[nodiscard]] Speeds speeds(std::ptrdiff_t i) const;
  void set_speeds(std::ptrdiff_t i, const Speeds& speeds);

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed("grains", states_);
    archive.fixed("forces", forces_);
    archive.fixed("places", places_);
    archive("places remembered", remembered_);
    archive.fixed("radii", radius_);
    archive.fixed("masses", mass_);
    archive.fixed("one over masses", per_mass_);
    archive.fixed("one over moments of inertia", per_inertia_);
    archive.fixed("radii in single precision", float_radius_);
    archive.fixed("identities", identity_);
    archive.fixed("springs", springs_);
    archive("origin", origin_);
  }

 private:
  struct alignas(D == 2 ? 64 : 32) State {
    double value[R::size];
  };
  struct alignas(32) Force {
    double value[R::force_size];
  };
  [[nodiscard]] double* state(std::ptrdiff_t i) { return states_[static_cast<std::size_t>(i)].value; }
  [[nodiscard]] const double* state(std::ptrdiff_t i) const { return states_[static_cast<std::size_t>(i)].value; }
  void set_rows();

  std::vector<State> states_;
  std::vector<Force> forces_;  ///< one more in front: a disc's torque adds zeros to the one before it
  std::vector<float> places_, remembered_;
  std::vector<double> radius_, mass_, per_mass_, per_inertia_;
  std::vector<float> float_radius_;
  std::vector<std::int32_t> identity_;
  std::vector<surface::Vec3> springs_;
  std::vector<double*> rows_[5];  ///< position, velocity, spin, force, torque as ParticleArrays has them
  double origin_[3] = {0.0, 0.0, 0.0};
  double largest_radius_ = 0.0;
  bool mixed_ = false;
};

}  // namespace grainstep::dem::native
