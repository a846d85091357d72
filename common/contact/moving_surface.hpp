/// @file The surface between two exchanges: it moves linearly from where it was to where it is told to be.
#pragma once

#include <algorithm>
#include <vector>

#include "grainstep/wire.pb.h"
#include "surface/polyline.hpp"

namespace grainstep::contact {

class MovingSurface {
 public:
  /// Throws InputError when the message is no surface in the plane.
  explicit MovingSurface(const wire::Surface& surface);

  [[nodiscard]] std::size_t node_count() const { return now_.node_count(); }

  /// Where the window in progress ends (m) and the mean velocity in it (m/s), node-major.
  void aim(const double* position, const double* velocity);

  /// Moves to `fraction` of the window in progress: 0 where it began, 1 where it ends.
  void move_to(double fraction);

  /// The window in progress has ended: the next one begins here.
  void arrive() { from_ = to_; }

  [[nodiscard]] const surface::Polyline& now() const { return now_; }
  [[nodiscard]] const std::vector<surface::Vec2>& velocity() const { return velocity_; }

  /// Speed (m/s) of the fastest node in the window in progress.
  [[nodiscard]] double fastest() const { return fastest_; }

  /// Largest distance (m) of a node, now and at the window's end, from where remember() was last called.
  [[nodiscard]] double wandered() const;
  void remember();

  /// What moves, of a surface of the same topology.
  template <class Archive>
  void serialize(Archive& archive) {
    std::vector<surface::Vec2> now(now_.nodes().begin(), now_.nodes().end());
    archive.fixed("now", now);
    archive.fixed("from", from_);
    archive.fixed("to", to_);
    archive.fixed("velocity", velocity_);
    archive.fixed("remembered", remembered_);
    archive("fastest", fastest_);
    if constexpr (Archive::loads) std::copy(now.begin(), now.end(), now_.nodes().begin());
  }

 private:
  void note_fastest();

  surface::Polyline now_;
  std::vector<surface::Vec2> from_, to_, velocity_, remembered_;
  double fastest_ = 0.0;
};

}  // namespace grainstep::contact
