/// @file What the surface has received up to now: per node, so that any interval's mean pressure can be formed, and
/// as the transmitted impulse (4.5), followed through chosen instants.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ledger/surface_load.hpp"

namespace grainstep::ledger {

/// Takes the windows' impulses in order. Impulses are sums of force times step; the last step's half still lies behind
/// t(n) when a window ends, and is left out of what has been received at t(n).
class LoadHistory {
 public:
  /// `window` in s; `steps`: impactor steps per window; `loaded_area`: 2 a b of what is modelled, m2, the area of
  /// (4.4); not a number where nobody says it: then the area of the loaded face.
  struct Clock {
    double window;
    unsigned steps;
  };
  LoadHistory(SurfaceLoad surface, Clock clock, double loaded_area);

  /// Asks for the transmitted impulse at time t (s), interpolated between windows. Call before the windows come.
  void watch(double time);

  void add(std::uint64_t window, std::span<const double> impulse);

  [[nodiscard]] double time() const { return time_; }                ///< s, t(n) of the last window added
  [[nodiscard]] double transmitted() const { return transmitted_; }  ///< Pa s, I_t at t(n)

  /// The watched instants that were passed: Pa s, in the order of watch(); NaN where the run has not come that far.
  [[nodiscard]] const std::vector<double>& watched() const { return watched_; }

  /// Nodal impulse received up to t(n), N s, nodes x dimension.
  [[nodiscard]] std::vector<double> received() const;

  [[nodiscard]] const SurfaceLoad& surface() const { return surface_; }

  /// What windows have left; the watched instants are those of whoever reads it back.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("window", window_);
    archive("time", time_);
    archive("transmitted", transmitted_);
    archive("of the loaded face", face_total_);
    archive("of the nodes", total_);
    archive("latest", latest_);
    archive("watched", watched_);
  }

 private:
  [[nodiscard]] double still_to_come() const;

  SurfaceLoad surface_;
  Clock clock_;
  double loaded_area_;
  std::uint64_t window_ = 0;
  double time_ = 0.0;
  double transmitted_ = 0.0;
  double face_total_ = 0.0;
  std::vector<double> total_;
  std::vector<double> latest_;
  std::vector<double> instants_;
  std::vector<double> watched_;
};

}  // namespace grainstep::ledger
