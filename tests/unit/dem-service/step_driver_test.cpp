// What the driver of a step asks of its guards: one particle by hand, no LAMMPS.
#include "dem-service/slug/step_driver.hpp"

#include <gmock/gmock.h>

#include <array>

#include "base/error.hpp"
#include "engine_rig.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;
using ::testing::HasSubstr;

/// One particle that flies far above the surface, reported after every step.
class OneParticle {
 public:
  explicit OneParticle(const Motion& motion = at_rest())
      : setup_(setup()),
        model_(model()),
        start_(start_of(model_.preferred_step, 2)),
        link_(setup_, start_, motion),
        exchange_(&link_, 2),
        driver_(model_, every_step(start_), {.dt = model_.preferred_step, .margin = 1e-3},
                MovingSurface(setup_.impactor().surface()), exchange_) {
    mass_ = model_.mass;
    driver_.rebuild(arrays());
  }

  void rebuild() { driver_.rebuild(arrays()); }
  void begin_step(std::uint64_t step) { driver_.before_pair_forces(step, arrays()); }
  void end_step(std::uint64_t step, const PairEnergy& pairs) { driver_.end_of_step(step, arrays(), pairs); }

  /// What would end the run.
  std::string failure() {
    try {
      exchange_.finish();
    } catch (const NumericalError& error) {
      return error.what();
    }
    return "";
  }

  std::array<double, 3> velocity_{0.0, -10.0, 0.0};
  [[nodiscard]] const ScriptedLink& link() const { return link_; }
  [[nodiscard]] double kinetic() const { return 0.5 * mass_ * velocity_[1] * velocity_[1]; }
  int owned_ = 1;

 private:
  static wire::Setup setup() {
    wire::Setup out = reference_setup();
    set_flat_surface(out, 0.1, 1);
    return out;
  }
  [[nodiscard]] SlugModel model() const {
    SlugModel out = model_of(setup_);
    out.particles = 1;
    return out;
  }
  static wire::Start every_step(wire::Start start) {
    start.set_report_every(1);
    return start;
  }
  ParticleArrays arrays() {
    return {.owned = owned_,
            .position = &position_at_,
            .velocity = &velocity_at_,
            .spin = &spin_at_,
            .force = &force_at_,
            .torque = &torque_at_,
            .radius = &radius_,
            .mass = &mass_,
            .identity = &identity_,
            .spring = &spring_};
  }

  wire::Setup setup_;
  SlugModel model_;
  wire::Start start_;
  ScriptedLink link_;
  Exchange exchange_;
  StepDriver driver_;
  std::array<double, 3> position_{0.0, 0.05, 0.0}, spin_{}, force_{}, torque_{};
  const double* position_at_ = position_.data();
  const double* velocity_at_ = velocity_.data();
  const double* spin_at_ = spin_.data();
  double* force_at_ = force_.data();
  double* torque_at_ = torque_.data();
  double radius_ = 0.5e-3;
  double mass_ = 0.0;
  std::int32_t identity_ = 1;
  surface::Vec3 spring_;
};

TEST(StepDriver, ADissipationThatFallsEndsTheRun) {
  OneParticle run;
  run.end_step(0, {.damping = 0.5 * run.kinetic()});
  EXPECT_EQ(run.failure(), "");
  run.end_step(1, {.damping = 0.4 * run.kinetic()});
  EXPECT_THAT(run.failure(), HasSubstr("what contacts have dissipated fell by"));
}

TEST(StepDriver, ADissipationThatGrowsDoesNot) {
  OneParticle run;
  for (const std::uint64_t step : {0U, 1U, 2U}) {
    run.end_step(step, {.damping = 0.1 * static_cast<double>(step) * run.kinetic()});
  }
  EXPECT_EQ(run.failure(), "");
  EXPECT_EQ(run.link().reports.size(), 3U);
}

TEST(StepDriver, ALostParticleEndsTheRun) {
  OneParticle run;
  run.owned_ = 0;
  run.end_step(1, {});
  EXPECT_THAT(run.failure(), HasSubstr("after 1 steps 0 of 1 particles are left"));
}

TEST(StepDriver, AParticleThatMovesFartherThanItsRadiusInAStepEndsTheRun) {
  OneParticle run;
  run.rebuild();
  EXPECT_EQ(run.failure(), "");
  run.velocity_[1] = -1e6;
  run.rebuild();
  EXPECT_THAT(run.failure(), HasSubstr("particle 1 moves more than its radius in one step"));
}

TEST(StepDriver, ASurfaceThatMovesFartherThanARadiusInAStepEndsTheRun) {
  OneParticle slow([](std::uint64_t window, const Vec2& start) {
    return start + Vec2{{0.0, -1e-5 * static_cast<double>(window)}};
  });
  slow.begin_step(1);
  EXPECT_EQ(slow.failure(), "");
  OneParticle fast([](std::uint64_t window, const Vec2& start) {
    return start + Vec2{{0.0, -1.0 * static_cast<double>(window)}};
  });
  fast.begin_step(1);
  EXPECT_THAT(fast.failure(), HasSubstr("a node of the surface moves at"));
}

TEST(StepDriver, ThePairsLargestOverlapIsSaidOnce) {
  OneParticle run;
  run.end_step(0, {.largest_overlap = 0.25});
  run.end_step(1, {.largest_overlap = 0.125});
  ASSERT_EQ(run.link().reports.size(), 2U);
  EXPECT_EQ(observable(run.link().reports[0], "max_overlap"), 0.25);
  EXPECT_EQ(observable(run.link().reports[1], "max_overlap"), 0.125);
}

}  // namespace
}  // namespace grainstep::dem
