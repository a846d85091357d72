/// @file A rigid target: its outline and nothing else. It does not move; its supports give back what it receives.
#pragma once

#include <limits>
#include <vector>

#include "fe-service/triangle.hpp"
#include "fe-service/windows.hpp"

namespace grainstep::fe {

/// What a rigid target reports as its stable and preferred step: no limit.
inline constexpr double kNoStepLimit = std::numeric_limits<double>::max();

class Rigid final : public WindowedStructure {
 public:
  explicit Rigid(const scene::Structure& structure);

  void fill_ready(wire::Ready& ready) const override;
  void start(const wire::Start& start) override;
  void advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) override;
  void report(wire::Report& report) override;
  void snapshot(wire::Snapshot& snapshot) override;
  void complete() override {}

 private:
  std::vector<Vec2> outline_;  ///< m, structure on the right-hand side
  std::uint64_t window_ = 0;
  Vec2 received_{0.0, 0.0};  ///< N s, all impulses
  Vec2 counted_{0.0, 0.0};   ///< N s, those up to t(n): half of the last one
};

}  // namespace grainstep::fe
