#include "ledger/load_history.hpp"

#include <cmath>
#include <limits>

#include "base/assert.hpp"

namespace grainstep::ledger {

LoadHistory::LoadHistory(SurfaceLoad surface, Clock clock, double loaded_area)
    : surface_(std::move(surface)),
      clock_(clock),
      loaded_area_(std::isfinite(loaded_area) ? loaded_area : surface_.area_of_face()),
      total_(surface_.values(), 0.0),
      latest_(surface_.values(), 0.0) {}

void LoadHistory::watch(double time) {
  instants_.push_back(time);
  watched_.push_back(std::numeric_limits<double>::quiet_NaN());
}

// The part of the latest window's impulse that belongs to times after t(n): all of it at the start (half a step), half
// of the last of the window's steps otherwise.
double LoadHistory::still_to_come() const { return window_ == 0 ? 1.0 : 0.5 / clock_.steps; }

void LoadHistory::add(std::uint64_t window, std::span<const double> impulse) {
  GS_ASSERT(impulse.size() == total_.size(), std::to_string(impulse.size()) + " != " + std::to_string(total_.size()));
  const double time_before = time_;
  const double transmitted_before = transmitted_;
  window_ = window;
  time_ = static_cast<double>(window) * clock_.window;
  for (std::size_t i = 0; i < impulse.size(); ++i) {
    total_[i] += impulse[i];
    latest_[i] = impulse[i];
  }
  const double on_face = surface_.impulse_on_face(impulse);
  face_total_ += on_face;
  transmitted_ = (face_total_ - still_to_come() * on_face) / loaded_area_;
  for (std::size_t i = 0; i < instants_.size(); ++i) {
    if (time_before < instants_[i] && instants_[i] <= time_) {
      const double part = (instants_[i] - time_before) / (time_ - time_before);
      watched_[i] = transmitted_before + part * (transmitted_ - transmitted_before);
    }
  }
}

std::vector<double> LoadHistory::received() const {
  std::vector<double> out(total_.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = total_[i] - still_to_come() * latest_[i];
  }
  return out;
}

}  // namespace grainstep::ledger
