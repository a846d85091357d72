#include "contact/moving_surface.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"

namespace grainstep::contact {
namespace {

using surface::Vec2;

std::vector<Vec2> in_pairs(const double* values, std::size_t nodes) {
  std::vector<Vec2> pairs(nodes);
  for (std::size_t i = 0; i < nodes; ++i) pairs[i] = {{values[2 * i], values[2 * i + 1]}};
  return pairs;
}

surface::Polyline polyline_of(const wire::Surface& message) {
  if (message.position_size() == 0 || message.position_size() % 2 != 0 || message.facet_size() == 0 ||
      message.facet_size() % 2 != 0 || message.velocity_size() != message.position_size()) {
    throw InputError("surface: expected two coordinates and velocities per node and two nodes per segment, found " +
                     std::to_string(message.position_size()) + ", " + std::to_string(message.velocity_size()) +
                     " and " + std::to_string(message.facet_size()) + " numbers");
  }
  std::vector<surface::Polyline::Segment> segments;
  for (int i = 0; i < message.facet_size(); i += 2) segments.push_back({message.facet(i), message.facet(i + 1)});
  return {in_pairs(message.position().data(), static_cast<std::size_t>(message.position_size()) / 2), segments};
}

}  // namespace

MovingSurface::MovingSurface(const wire::Surface& surface)
    : now_(polyline_of(surface)),
      from_(now_.nodes().begin(), now_.nodes().end()),
      to_(from_),
      velocity_(in_pairs(surface.velocity().data(), from_.size())),
      remembered_(from_) {
  note_fastest();
}

void MovingSurface::aim(const double* position, const double* velocity) {
  for (std::size_t i = 0; i < to_.size(); ++i) {
    to_[i] = {{position[2 * i], position[2 * i + 1]}};
    velocity_[i] = {{velocity[2 * i], velocity[2 * i + 1]}};
  }
  note_fastest();
}

void MovingSurface::move_to(double fraction) {
  const auto nodes = now_.nodes();
  if (fraction >= 1.0) {
    std::copy(to_.begin(), to_.end(), nodes.begin());  // exactly, without the round-off of a sum
    return;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = from_[i] + fraction * (to_[i] - from_[i]);
}

void MovingSurface::note_fastest() {
  double largest = 0.0;
  for (const Vec2& v : velocity_) largest = std::max(largest, dot(v, v));
  fastest_ = std::sqrt(largest);
}

double MovingSurface::wandered() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < to_.size(); ++i) {
    const Vec2 now = now_.nodes()[i] - remembered_[i];
    const Vec2 later = to_[i] - remembered_[i];
    largest = std::max({largest, dot(now, now), dot(later, later)});
  }
  return std::sqrt(largest);
}

void MovingSurface::remember() { std::copy(now_.nodes().begin(), now_.nodes().end(), remembered_.begin()); }

}  // namespace grainstep::contact
