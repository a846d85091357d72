#include "load/surface_account.hpp"

#include <algorithm>

namespace grainstep::load {

SurfaceAccount::SurfaceAccount(const wire::Surface& surface)
    : velocity_(surface.velocity().begin(), surface.velocity().end()),
      given_(surface.dimension() == 0 ? 2 : surface.dimension(), 0.0) {
  velocity_.resize(static_cast<std::size_t>(surface.position_size()), 0.0);
  last_step_.assign(velocity_.size(), 0.0);
}

// Up to t(n): what the steps before it gave, and the half of the step around it that lies behind.
void SurfaceAccount::give(std::uint64_t window, std::span<const double> impulse, std::span<const double> last) {
  const double ahead = window == 0 ? 1.0 : 0.5;
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    const double behind = impulse[i] - ahead * last[i];
    given_[i % given_.size()] += behind;
    work_ += behind * velocity_[i];
  }
  std::copy(last.begin(), last.end(), last_step_.begin());
}

// What was still ahead of the step at the start of the window that has just passed.
void SurfaceAccount::take(const wire::Kinematics& surface) {
  const bool first = surface.window() == 1;
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    const double coming = surface.velocity(static_cast<int>(i));
    given_[i % given_.size()] += (first ? 1.0 : 0.5) * last_step_[i];
    work_ += 0.5 * last_step_[i] * (first ? velocity_[i] + coming : coming);
  }
  velocity_.assign(surface.velocity().begin(), surface.velocity().end());
}

}  // namespace grainstep::load
