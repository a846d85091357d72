/// @file Forces on particles that somebody else looks after: kept until all who compute have come to an end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grainstep::dem {

class OutsideForces {
 public:
  static constexpr std::size_t values = 6;  ///< force (N) and torque (N m)

  /// Room for so many more.
  void reserve(std::size_t more) {
    const std::size_t room = particle_.size() + more;
    if (room * values > forces_.size()) forces_.resize(2 * room * values, 0.0);
    particle_.reserve(forces_.size() / values);
  }
  /// Zeros to be added to; what add() has not been called for stays where it is.
  [[nodiscard]] double* next() { return forces_.data() + particle_.size() * values; }
  void add(std::int32_t particle) { particle_.push_back(particle); }

  /// Calls use(particle, forces) for all, in the order in which they came, and forgets them.
  template <typename Use>
  void take(Use&& use) {
    double* forces = forces_.data();
    for (const std::int32_t particle : particle_) {
      use(particle, static_cast<const double*>(forces));
      for (std::size_t c = 0; c < values; ++c) *forces++ = 0.0;
    }
    particle_.clear();
  }

 private:
  std::vector<std::int32_t> particle_;
  std::vector<double> forces_;
};

}  // namespace grainstep::dem
