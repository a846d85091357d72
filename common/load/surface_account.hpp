/// @file What an impactor without a model of its own has given to the surface, and what the surface has received, up to
/// the moment t(n) of a report: impulses, and the work that they did on it (docs/theory/step.md).
///
/// The structure takes up the impulse of t(n) half with the velocity before it and half with the one after; so does
/// this. All of the first one, which is half a step's, lies ahead of t = 0.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grainstep/wire.pb.h"

namespace grainstep::load {

class SurfaceAccount {
 public:
  SurfaceAccount() = default;
  /// Of the velocities of `surface` (m/s, nodes x dimension); none: it is at rest.
  explicit SurfaceAccount(const wire::Surface& surface);

  /// Window n has given `impulse` (N s, nodes x dimension), of which `last` in its last step, which stands at t(n); the
  /// same where the window is one step.
  void give(std::uint64_t window, std::span<const double> impulse, std::span<const double> last);

  /// The surface has moved on to t(n).
  void take(const wire::Kinematics& surface);

  [[nodiscard]] const std::vector<double>& impulse() const { return given_; }  ///< N s, one per dimension
  [[nodiscard]] double work() const { return work_; }                          ///< J
  [[nodiscard]] std::span<const double> velocity() const { return velocity_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed("velocity", velocity_);
    archive.fixed("last step", last_step_);
    archive.fixed("given", given_);
    archive("work", work_);
  }

 private:
  std::vector<double> velocity_;   ///< m/s, that carried the surface here; at the start the initial one
  std::vector<double> last_step_;  ///< N s, nodal, of the window's last step
  std::vector<double> given_;      ///< N s
  double work_ = 0.0;              ///< J
};

}  // namespace grainstep::load
