/// @file A rigid target: its outline and nothing else. It does not move, and its supports give back what it receives;
/// or it is a free mass that moves along x2 without turning, held along x1 by a frictionless guide.
///
/// The free mass M is stepped by central differences like a deformable structure (deformable.hpp), q steps in a window,
/// each with an equal share of its impulse. Only the surface pushes it, so any step is stable.
#pragma once

#include <vector>

#include "base/archive.hpp"
#include "fe-service/measure.hpp"
#include "fe-service/triangle.hpp"
#include "fe-service/windows.hpp"

namespace grainstep::fe {

class Rigid final : public WindowedStructure {
 public:
  Rigid(const scene::Structure& structure, const Measure& measure);

  void fill_ready(wire::Ready& ready) const override;
  void start(const wire::Start& start) override;
  void advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) override;
  void report(wire::Report& report) override;
  void snapshot(wire::Snapshot& snapshot) override;
  void complete() override {}
  [[nodiscard]] std::string save() override { return base::saved(*this); }
  void restore(std::string_view state) override { base::restore(*this, state); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("velocity", velocity_);
    archive("height", height_);
    archive("work", work_);
    archive("received", received_);
    archive("peak deflection", peak_);
    archive("its time", peak_time_);
    archive("window", window_);
  }

 private:
  using Doubles = google::protobuf::RepeatedField<double>;
  /// At t(n).
  struct State {
    double deflection = 0.0, peak = 0.0;  ///< m, along -x2
    double peak_time = 0.0;               ///< s
    double kinetic = 0.0;                 ///< J, the product of the half steps' velocities (observe.hpp)
    double momentum = 0.0;                ///< N s, along x2
    double work = 0.0;                    ///< J, through the surface
    Vec2 received{0.0, 0.0};              ///< N s, through the surface
  };

  void fill_nodes(Doubles& position, Doubles& velocity, double speed) const;
  [[nodiscard]] State state_before(Vec2 share) const;
  void step(Vec2 share, std::uint32_t k);

  std::vector<Vec2> outline_;  ///< m, undeformed; structure on the right-hand side
  bool free_;
  double mass_ = 0.0;        ///< kg, of what is modelled; of a free target only
  double velocity_ = 0.0;    ///< m/s along x2, at t(n-1/2); at the start V(0)
  double height_ = 0.0;      ///< m, along x2
  double work_ = 0.0;        ///< J, of all impulses
  Vec2 received_{0.0, 0.0};  ///< N s, all impulses
  double peak_ = 0.0, peak_time_ = 0.0;

  double window_length_ = 0.0;
  std::uint32_t steps_ = 1;  ///< per window
  std::uint64_t window_ = 0;
  State at_;  ///< where the last window began
};

}  // namespace grainstep::fe
