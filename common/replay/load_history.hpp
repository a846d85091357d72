/// @file The load that a record holds, for windows and a mesh of one's own.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grainstep/wire.pb.h"
#include "replay/recording.hpp"
#include "surface/polyline.hpp"

namespace grainstep::replay {

/// In time: the impulse of recorded window n acts evenly between the middles of the windows beside it, that of the
/// first one from t = 0 on. A window of the run receives what falls between the middles beside its own end; so the sum
/// up to any time is that of the record. Where both have the same windows, each is handed on as it is.
///
/// In space: a recorded node's impulse goes to the two nodes of the segment that it lies on (undeformed), by the
/// segment's linear shape functions: force and moment stay what they were. Where the surfaces are the same, each node's
/// is its own.
class LoadHistory {
 public:
  /// `surface`: of the structure in this run, at its start. InputError where it is another one than the recorded, and
  /// has three dimensions.
  LoadHistory(Recording& recording, const wire::Surface& surface, const std::string& key);

  /// `window`: of the run, s. InputError where `end` (s) lies behind the record's and the load is not over.
  void agree(double window, double end);

  /// Of window n, N s, nodes x dimension of the run's surface. InputError where a load lies beside the surface.
  void impulse(std::uint64_t window, std::span<double> out);

  /// How fast the surface gives way where it is loaded, along the load; sums over nodes and windows.
  struct Retreat {
    double impulse = 0.0;    ///< N s, of the sizes of nodal impulses
    double work = 0.0;       ///< J, impulse times the surface's velocity
    double departure = 0.0;  ///< J, the same of the velocity beyond the recorded one
  };
  /// Adds that of the end of window n, at which the surface's nodes have `velocity` (m/s).
  void add_retreat(std::uint64_t window, std::span<const double> velocity, Retreat& sums);

 private:
  void find_places(const wire::Surface& surface);
  void require_over(double end);
  /// The windows of the record whose impulses act in window n of the run, and how much of each.
  template <typename Each>
  void for_each_part(std::uint64_t window, Each each);
  void add(std::uint64_t recorded, double part, std::span<double> out);
  [[nodiscard]] double interpolated(std::span<const double> field, std::size_t node, unsigned axis) const;

  Recording& recording_;
  std::string key_;
  unsigned dimension_;
  bool same_surface_;
  bool same_windows_ = true;
  double window_ = 0.0;  // s
  std::optional<surface::Polyline> polyline_;
  std::vector<surface::ClosestPoint> places_;  // of recorded nodes; none where the surfaces are the same
  double tolerance_ = 0.0;                     // m: what lies farther from the surface is beside it
};

}  // namespace grainstep::replay
