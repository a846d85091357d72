/// @file The frequency of a mode from half a period of a body's free motion.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "fe_motion.hpp"

namespace grainstep::fe::test {

/// Velocities of a mode on a body's nodes, and how far the body has moved along them since the start.
class ModeShape {
 public:
  /// shape(nodes, index) is the mode's velocity at a node.
  template <class Shape>
  ModeShape(Body& body, Shape shape) : body_(body) {
    for (auto& velocities : velocities_) velocities.resize(std::max(body.corners.x.size(), body.centres.x.size()));
    for_each_node(body, [&](Nodes& nodes, std::size_t i) { velocities_of(nodes)[i] = shape(nodes, i); });
  }

  /// The body gets `factor` times the mode's velocities.
  void set_velocities(double factor) {
    for_each_node(body_, [&](Nodes& nodes, std::size_t i) {
      nodes.u[i] = factor * velocities_of(nodes)[i].x;
      nodes.v[i] = factor * velocities_of(nodes)[i].y;
    });
  }

  /// Displacements weighted with masses and the mode's velocities.
  [[nodiscard]] double projection() {
    double sum = 0.0;
    for_each_node(body_, [&](Nodes& nodes, std::size_t i) {
      const Vec2 moved{nodes.x[i] - nodes.x0[i], nodes.y[i] - nodes.y0[i]};
      sum += nodes.mass[i] * dot(moved, velocities_of(nodes)[i]);
    });
    return sum;
  }

 private:
  std::vector<Vec2>& velocities_of(const Nodes& nodes) { return velocities_[&nodes == &body_.corners ? 0 : 1]; }

  Body& body_;
  std::array<std::vector<Vec2>, 2> velocities_;
};

/// Circular frequency (1/s) of a mode, found within 40% of `expected`: the body starts undeformed with the velocities
/// shape(nodes, index), and its projection on them returns to zero after half a period. hold(body) keeps the supports;
/// steps are `courant` of the stable one.
template <class Shape, class Hold>
double frequency_of_mode(Body& body, double expected, double courant, Shape shape, Hold hold) {
  constexpr double small = 1e-3;  // geometrically linear
  ModeShape mode(body, shape);
  mode.set_velocities(small);
  Stepper stepper(body, courant * body.stable_step());
  const double half_period = M_PI / expected;
  double before = 0.0, time_before = 0.0;
  while (stepper.time() < 2.0 * half_period) {
    stepper(hold);
    if (stepper.time() < 0.7 * half_period) continue;
    const double now = mode.projection();
    if (now <= 0.0) return M_PI / (time_before + (stepper.time() - time_before) * before / (before - now));
    before = now;
    time_before = stepper.time();
  }
  ADD_FAILURE() << "does not return";
  return 0.0;
}

/// For frequency_of_mode() of bodies in clamps.
inline void in_clamps(Body& body) { (void)body.hold_supports(); }

}  // namespace grainstep::fe::test
