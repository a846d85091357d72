/// @file A rigid mass on a spring as a structure: a solver of one's own, small enough to read at once.
///
/// The scene says what it is, under keys that nobody but this program reads:
///
///     structure:
///       type: external
///       program: build-spring/spring
///       external: {mass: 0.4, stiffness: 2.0e6, width: 0.2}    # kg, N/m, m
#pragma once

#include <participant/backend.hpp>

/// Central differences: M (V(n+1/2) - V(n-1/2)) = J(n) - K X(n) delta, X(n+1) = X(n) + delta V(n+1/2). The impulse J(0)
/// comes with half its weight already; so does the spring's, at the start. Its surface is one segment on the x1 axis,
/// from -width/2 to width/2, or from 0 to width/2 in a half model. It moves along x2 only.
class Spring final : public grainstep::participant::StructureBackend {
 public:
  [[nodiscard]] grainstep::wire::Hello describe() const override;
  [[nodiscard]] grainstep::wire::Ready prepare(const grainstep::wire::Setup& setup) override;
  void start(const grainstep::wire::Start& start) override;
  void advance(const grainstep::wire::Forces& forces, grainstep::participant::Due due,
               grainstep::wire::Kinematics& next) override;
  void report(grainstep::wire::Report& report) override;
  void snapshot(grainstep::wire::Snapshot& snapshot) override;
  void complete() override {}

 private:
  /// At t(n): velocities of the half steps before and after it, averaged; half of this step's impulses counts before
  /// it. The work of an impulse is booked with the velocities before and after it, half and half, and what moves has
  /// the energy (1/2) M V(n-1/2) V(n+1/2): so the books close to round-off, from the first step of a sudden load on.
  struct State {
    double x = 0.0, v = 0.0;
    double kinetic = 0.0, work = 0.0;  // J; done by the impulses
    double received[2] = {0.0, 0.0};   // N s, through the surface
    double held[2] = {0.0, 0.0};       // N s, by the spring's foundation, and along x1 by its guide
  };
  [[nodiscard]] grainstep::wire::Surface surface() const;

  double mass_ = 0.0, stiffness_ = 0.0, left_ = 0.0, right_ = 0.0;
  double step_ = 0.0;
  unsigned steps_in_window_ = 1;
  State state_;  // velocity of the half step before
  State at_;     // at t(n), for the report
  double peak_ = 0.0, peak_time_ = 0.0;
  std::uint64_t steps_ = 0;
};
