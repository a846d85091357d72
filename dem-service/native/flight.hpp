/// @file Grains in free flight that nothing has reached yet: where they are follows from where they began, and nobody
/// needs to know before something comes near. They are left alone until then; waking them too early costs a little
/// time, too late would lose a contact.
///
/// Sorted by how far behind the head they fly, sleepers are the tail of the order. docs/decisions/0019.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "dem-service/slug/layout.hpp"

namespace grainstep::dem::native {

class Flight {
 public:
  /// Sorts the particles, the head first. All of them are awake where they do not fly alike, or where something that
  /// they could meet on their way does not come with their front: walls that they fly towards.
  Flight(const SlugModel& model, std::vector<PlacedParticle>& particles);

  /// Of each particle in its new place: how many stood before it at first, and one.
  [[nodiscard]] const std::vector<std::int32_t>& identities() const { return identity_; }

  [[nodiscard]] std::int32_t awake() const { return awake_; }
  [[nodiscard]] bool all_awake() const { return awake_ == static_cast<std::int32_t>(start_.size()); }
  [[nodiscard]] const surface::Vec3& velocity() const { return velocity_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("awake", awake_);
    if constexpr (Archive::loads) {
      if (awake_ < 0 || awake_ > static_cast<std::int32_t>(start_.size())) throw std::range_error("too many awake");
    }
  }

  /// How far behind the head's place at the start, as seen by who flies along, m.
  [[nodiscard]] double behind(const double* position, double time) const;

  /// Whether a sleeper may be met by what is `front` behind, or by a surface that nowhere rises above `top` (m), within
  /// `room` (m).
  [[nodiscard]] bool near(double front, double top, double time, double room) const;

  /// Wakes everyone of whom near() is true. Returns how many are awake now.
  std::int32_t wake(double front, double top, double time, double room);

  /// Where sleeper i is, m.
  [[nodiscard]] surface::Vec3 place(std::int32_t i, double time) const {
    return start_[static_cast<std::size_t>(i)] + time * velocity_;
  }

 private:
  std::vector<surface::Vec3> start_;  ///< m
  std::vector<std::int32_t> identity_;
  std::vector<double> behind_;  ///< m, of a grain's leading point
  std::vector<double> lowest_;  ///< m, x2 of the lowest point of this grain and of all behind it
  surface::Vec3 velocity_;
  surface::Vec3 ahead_;  ///< unit vector
  double speed_ = 0.0;
  std::int32_t awake_ = 0;
};

}  // namespace grainstep::dem::native
