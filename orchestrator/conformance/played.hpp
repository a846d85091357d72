/// @file A run in which everything but the participant under test is played by hand: the orchestrator and the other
/// side.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "orchestrator/conformance/bench.hpp"
#include "orchestrator/session/check_report.hpp"

namespace grainstep::conformance {

using Vector = std::array<double, 3>;

/// What the other side does.
struct Plan {
  std::uint64_t windows = 20;
  unsigned steps = 1;  ///< of the participant under test, in a window
  double report_every = 1.0;
  double snapshot_every = 0.0;
  /// N, on the whole surface in a window; to all nodes alike. To a structure.
  std::function<Vector(std::uint64_t)> force = [](std::uint64_t) { return Vector{}; };
  Vector surface_velocity = {};  ///< m/s, of a rigid surface. To an impactor.
};

/// A rigid target at rest: flat, at x2 = 0, as wide as the scene's structure (0.1 m to each side where it says
/// nothing).
[[nodiscard]] wire::Surface flat_surface(const Bench& bench);

/// Order of calls: begin, step as long as it is not over; or run, which does all that and stops.
class Played {
 public:
  Played(Subject& subject, const Bench& bench, Plan plan);

  void begin();
  void step();
  [[nodiscard]] bool over() const { return window_ > plan_.windows; }
  void run();

  void tell_wrong_window();
  void tell_wrong_length();

  [[nodiscard]] double window() const { return start_.window(); }  ///< s

  /// N s: what was handed over before window n, and in it.
  [[nodiscard]] Vector given_before(std::uint64_t n) const;
  [[nodiscard]] Vector given_in(std::uint64_t n) const;

  std::vector<wire::Forces> forces;          ///< by window
  std::vector<wire::Kinematics> kinematics;  ///< from window 0, the start, on
  std::vector<wire::Report> reports;
  std::vector<wire::Snapshot> snapshots;

 private:
  [[nodiscard]] wire::Forces pushing(std::uint64_t window) const;
  [[nodiscard]] wire::Kinematics moved(std::uint64_t window) const;
  void require_length(const char* what, int found) const;
  void hear_extra();

  Subject& subject_;
  const Bench& bench_;
  Plan plan_;
  wire::Surface surface_;
  wire::Start start_;
  orchestrator::ReportCheck check_;
  std::uint64_t window_ = 0;
};

}  // namespace grainstep::conformance
