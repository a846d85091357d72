/// @file The equivalent foam projectile as an impactor: a block of foam whose nodes touch the structure's surface.
///
/// A window of length T is done in p steps h = T/p, more where elements that flatten ask for it. Each is a step of
/// central differences, as of a structure (deformable.hpp): at t(k) contact and internal forces, whose impulses count
/// half for the step before and half for the one after, take V(k-1/2) to V(k+1/2). The surface moves linearly within a
/// window, and what is handed over is the impulse of all contact forces in it. Reports at t(n) interpolate the velocity
/// between both steps and count the same part of each impulse, so that momentum closes to round-off.
#pragma once

#include <memory>
#include <optional>

#include "fe-service/foam/block.hpp"
#include "fe-service/foam/block_contact.hpp"
#include "fe-service/guards.hpp"
#include "fe-service/observe.hpp"
#include "participant/backend.hpp"

namespace grainstep::fe {

class FoamImpactor final : public participant::ImpactorBackend {
 public:
  [[nodiscard]] wire::Hello describe() const override;
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override;
  void run(const wire::Start& start, participant::ImpactorLink& link) override;

  /// What a window leaves for the next one.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("body", *body_);
    archive("surface", *surface_);
    archive("contact", *contact_);
    archive("stable step", stable_step_);
    archive("window", window_);
    archive("steps in it", steps_in_window_);
    archive("of them done", step_in_window_);
    archive("steps needed", steps_needed_);
    archive("step before", step_before_);
    archive("steps", steps_);
    archive("last good time", last_good_time_);
    archive("plastic work", plastic_work_);
    archive("stored", stored_);
    archive("quality", min_quality_);
    archive("supports", supports_);
  }

 private:
  [[nodiscard]] bool begin(const wire::Start& start, participant::ImpactorLink& link);
  [[nodiscard]] bool at_end_of_window() const { return step_in_window_ == steps_in_window_; }
  void touch(participant::ImpactorLink& link);
  void move(participant::ImpactorLink& link);
  [[nodiscard]] bool receive(participant::ImpactorLink& link);
  void internal_forces();
  void check_block();
  void report(const Velocities& before, const Velocities& at, Vec2 supports, participant::ImpactorLink& link);
  [[nodiscard]] Progress progress() const;
  [[nodiscard]] double step() const { return window_length_ / steps_in_window_; }
  [[nodiscard]] double next_step() const { return at_end_of_window() ? window_length_ / steps_needed_ : step(); }

  std::optional<FoamModel> model_;
  std::optional<Body> body_;
  std::optional<contact::MovingSurface> surface_;
  std::optional<BlockContact> contact_;
  scene::Guards guards_;
  double undeformed_step_ = 0.0, stable_step_ = 0.0;

  double window_length_ = 0.0;
  std::uint64_t window_ = 0;           ///< n: the window in progress ends with t(n)
  std::uint32_t steps_in_window_ = 1;  ///< p of the window in progress
  std::uint32_t step_in_window_ = 1;   ///< k: the state stands at the end of this step
  std::uint32_t steps_needed_ = 1;     ///< p of the next one
  double step_before_ = 0.0;           ///< s; 0 at the start
  std::uint64_t steps_ = 0;
  double last_good_time_ = 0.0;
  double plastic_work_ = 0.0;
  double stored_ = 0.0;  ///< J, work of the elastic strains
  double min_quality_ = 1.0;
  Vec2 supports_{0.0, 0.0};  ///< N s, of all steps
  std::vector<surface::Vec2> nodal_;
};

}  // namespace grainstep::fe
