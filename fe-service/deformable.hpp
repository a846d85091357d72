/// @file A deformable structure in a run: central differences, window by window.
///
/// A window of length Delta is done in q steps delta = Delta/q, each of them
///     M (V(k+1/2) - V(k-1/2)) = (delta_before + delta)/2 F_int(k) + J/q + supports,   X(k+1) = X(k) + delta V(k+1/2)
/// where J is the impulse that arrived for the window (so momentum is exact at any q), and delta_before is the previous
/// step (0 at t = 0, where J comes with half its weight already). q grows where the stable step shrinks.
///
/// Reports at t(n) hold the velocity interpolated to t(n): V(n) = V(n-1/2) + w (V(n+1/2) - V(n-1/2)) with w =
/// delta_before/(delta_before + delta), i.e. 1/2 with equal steps and 0 at the start. The ledgers count the same
/// fraction w of the impulses of that step, of the surface and of the supports: so they close to round-off. For q = 1
/// the interface impulse at t(n) is the sum of J(m < n) plus J(n)/2.
#pragma once

#include "base/archive.hpp"
#include "fe-service/guards.hpp"
#include "fe-service/observe.hpp"
#include "fe-service/windows.hpp"

namespace grainstep::fe {

/// Part of the stable step that is taken. The bound by single quads is itself safe (on a square mesh it is 4% below the
/// limit of the assembled body); the tenth left covers what elements shrink between two checks (kCheckInterval) and the
/// damping-free limit of central differences, where round-off still grows.
inline constexpr double kStepSafety = 0.9;
/// More steps are taken once a step exceeds this part of the stable step: above kStepSafety, so that a run that starts
/// with its preferred step is not refined at the first bent element.
inline constexpr double kStepLimit = 0.97;
/// Windows between two computations of the stable step. An element would have to lose 3% of its height in 10 steps of
/// 1e-7 s, a strain rate of 3e4 1/s, to pass the limit in between.
inline constexpr std::uint64_t kCheckInterval = 10;

class Deformable final : public WindowedStructure {
 public:
  Deformable(const scene::Structure& structure, const scene::Guards& guards, const Measure& measure,
             base::Team* team = nullptr);

  void fill_ready(wire::Ready& ready) const override;
  void start(const wire::Start& start) override;
  void advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) override;
  void report(wire::Report& report) override;
  void snapshot(wire::Snapshot& snapshot) override;
  void complete() override;
  [[nodiscard]] std::string save() override { return base::saved(*this); }
  void restore(std::string_view state) override { base::restore(*this, state); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("body", body_);
    archive("stable step", stable_step_);
    archive("window", window_);
    archive("substeps", substeps_);
    archive("step before", step_before_);
    archive("received", received_);
    archive("plastic work", plastic_work_);
    archive("viscous work", viscous_work_);
    archive("quality", min_quality_);
    archive("steps", steps_);
    archive("last good time", last_good_time_);
    archive("peak deflection", peak_deflection_);
    archive("its time", peak_deflection_time_);
    archive("peak compression", peak_compression_);
    archive("its time", peak_compression_time_);
    archive("sums over elements", element_sums_);
  }

  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] std::uint32_t substeps() const { return substeps_; }

 private:
  /// Sums since t = 0.
  struct Received {
    Vec2 interface { 0.0, 0.0 }, supports{0.0, 0.0};  ///< N s
    double work = 0.0;                                ///< J, through the surface
    double work_before = 0.0;                         ///< J, the same with the velocities before the step
  };

  /// Sums over the elements of t(n), which a report needs.
  struct ElementSums {
    double elastic = 0.0;  ///< J
    PlasticExtent plastic;
  };

  [[nodiscard]] ElementSums sum_elements() const { return {elastic_energy(body_), plastic_extent(body_)}; }
  [[nodiscard]] Received kick(const wire::Forces& forces, double internal_weight);
  void keep(participant::Due due, const Velocities& before, double weight, const Received& gained);
  void fill_report(const Velocities& before, const Velocities& at, const Received& until);
  void internal_forces();
  void track_peaks(std::uint32_t substep);
  void fill_kinematics(wire::Kinematics& next) const;
  void adapt();
  [[nodiscard]] Progress progress() const;
  [[nodiscard]] double step() const { return window_length_ / substeps_; }

  scene::Guards guards_;
  Body body_;
  std::vector<std::size_t> surface_;  ///< indices of corners
  double undeformed_step_;            ///< s, stable step of the undeformed body
  double stable_step_;

  double window_length_ = 0.0;
  std::uint64_t window_ = 0;  ///< n: the state stands at t(n) between complete() and advance()
  std::uint32_t substeps_ = 1;
  bool substeps_fixed_ = false;
  double step_before_ = 0.0;

  Received received_;
  double plastic_work_ = 0.0;
  double viscous_work_ = 0.0;  ///< J, of bulk viscosity
  double min_quality_ = 1.0;
  std::uint64_t steps_ = 0;
  double last_good_time_ = 0.0;
  double peak_deflection_ = 0.0, peak_deflection_time_ = 0.0;
  double peak_compression_ = 0.0, peak_compression_time_ = 0.0;  ///< of the core
  std::vector<Vec2> travelled_;  ///< of the surface's nodes in this window: sum of their steps' velocities, m/s

  wire::Start start_;
  std::optional<ElementSums> element_sums_;  ///< of t(n), taken beforehand
  wire::Report report_;
  wire::Snapshot snapshot_;
};

}  // namespace grainstep::fe
