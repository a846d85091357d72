#include "dem-service/native/flight.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace grainstep::dem::native {
namespace {

using surface::Vec3;

bool fly_alike(const std::vector<PlacedParticle>& particles) {
  const PlacedParticle& one = particles.front();
  return std::all_of(particles.begin(), particles.end(),
                     [&](const PlacedParticle& p) { return p.velocity.c == one.velocity.c && p.spin == 0.0; });
}

/// Mirror and walls stand upright: who flies straight down does not come nearer to them.
bool meet_no_plane(const SlugModel& model, const Vec3& velocity) {
  const bool upright = velocity[0] == 0.0 && velocity[2] == 0.0;
  return upright || (!model.mirror && !model.confined && !model.spheres());
}

double radius_of(const SlugModel& model, const PlacedParticle& particle) {
  return (particle.diameter > 0.0 ? particle.diameter : model.diameter) / 2.0;
}

}  // namespace

Flight::Flight(const SlugModel& model, std::vector<PlacedParticle>& particles)
    : identity_(particles.size()), velocity_(particles.front().velocity), speed_(norm(velocity_)) {
  const bool sleep = speed_ > 0.0 && fly_alike(particles) && meet_no_plane(model, velocity_);
  std::iota(identity_.begin(), identity_.end(), 1);
  if (sleep) {
    ahead_ = velocity_ * (1.0 / speed_);
    const auto at = [&](std::int32_t identity) -> const PlacedParticle& {
      return particles[static_cast<std::size_t>(identity) - 1];
    };
    std::sort(identity_.begin(), identity_.end(), [&](std::int32_t a, std::int32_t b) {
      const double lead = dot(at(a).position, ahead_) - dot(at(b).position, ahead_);
      return lead > 0.0 || (lead == 0.0 && a < b);
    });
    std::vector<PlacedParticle> sorted(particles.size());
    std::transform(identity_.begin(), identity_.end(), sorted.begin(), at);
    particles = std::move(sorted);
  }
  for (const PlacedParticle& particle : particles) {
    start_.push_back(particle.position);
    const double radius = radius_of(model, particle);
    behind_.push_back(-dot(particle.position, ahead_) - radius);
    lowest_.push_back(particle.position[1] - radius);
  }
  for (std::size_t i = lowest_.size() - 1; i > 0; --i) lowest_[i - 1] = std::min(lowest_[i - 1], lowest_[i]);
  // Of unequal grains a large one far behind may reach further ahead than a small one before it.
  for (std::size_t i = behind_.size() - 1; i > 0; --i) behind_[i - 1] = std::min(behind_[i - 1], behind_[i]);
  if (!sleep) awake_ = static_cast<std::int32_t>(particles.size());
}

double Flight::behind(const double* position, double time) const {
  const Vec3 x{{position[0], position[1], position[2]}};
  return -dot(x, ahead_) + speed_ * time;
}

bool Flight::near(double front, double top, double time, double room) const {
  if (all_awake()) return false;
  const auto next = static_cast<std::size_t>(awake_);
  return behind_[next] < front + room || lowest_[next] + velocity_[1] * time < top + room;
}

std::int32_t Flight::wake(double front, double top, double time, double room) {
  while (near(front, top, time, room)) ++awake_;
  return awake_;
}

}  // namespace grainstep::dem::native
