/// @file The prescribed load as the orchestrator drives it, against a surface that moves as told.
#include "fe-service/load/prescribed_load.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fe {
namespace {

constexpr double window = 0.01;  // s
constexpr double round_off = 1e-13;

/// A face of two segments from 0 to 2 at x2 = height(t), and everything that the load sends.
class Rig final : public participant::ImpactorLink {
 public:
  Rig(const std::function<double(double)>& height, std::uint32_t steps) : height_(height) {
    start_.set_window(window);
    start_.set_windows(60);
    start_.set_impactor_steps(steps);
    start_.set_structure_steps(1);
    start_.set_report_every(1);
  }

  void run(const scene::Impactor& impactor) {
    wire::Setup setup;
    setup.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
    setup.set_depth(0.5);
    setup.set_scene_hash(7);
    *setup.mutable_impactor()->mutable_impactor() = impactor;
    wire::Surface& surface = *setup.mutable_impactor()->mutable_surface();
    for (const double value : nodes(height_(0.0))) surface.add_position(value);
    for (const double value : nodes(0.0)) surface.add_velocity(0.0 * value);
    for (const std::uint32_t node : {0U, 1U, 1U, 2U}) surface.add_facet(node);
    PrescribedLoad load;
    ready = load.prepare(setup);
    load.run(start_, *this);
  }

  const wire::Kinematics* surface(std::uint64_t n) override {
    kinematics_.Clear();
    kinematics_.set_window(n);
    const double now = height_(window * static_cast<double>(n));
    const double before = height_(window * (static_cast<double>(n) - 1.0));
    for (const double value : nodes(now)) kinematics_.add_position(value);
    for (int k = 0; k < 3; ++k) {
      kinematics_.add_velocity(0.0);
      kinematics_.add_velocity((now - before) / window);
    }
    return &kinematics_;
  }
  participant::Due due(std::uint64_t n) const override { return participant::due_at(start_, n); }
  void send(const wire::Forces& message) override { forces.push_back(message); }
  void send(wire::Report& message) override { reports.push_back(message); }
  void send(const wire::Snapshot& /*message*/) override { ADD_FAILURE() << "nobody asked for it"; }

  /// N s along x2, of all windows.
  [[nodiscard]] double total() const {
    double sum = 0.0;
    for (const wire::Forces& message : forces) {
      for (int i = 1; i < message.impulse_size(); i += 2) sum += message.impulse(i);
    }
    return sum;
  }

  wire::Ready ready;
  std::vector<wire::Forces> forces;
  std::vector<wire::Report> reports;

 private:
  static std::vector<double> nodes(double height) { return {0.0, height, 1.0, height, 2.0, height}; }

  std::function<double(double)> height_;
  wire::Start start_;
  wire::Kinematics kinematics_;
};

scene::Impactor rectangular(double pressure, double duration) {
  scene::Impactor impactor;
  impactor.set_type(scene::Impactor::TYPE_PRESSURE);
  impactor.mutable_pressure()->mutable_rectangular()->set_pressure(pressure);
  impactor.mutable_pressure()->mutable_rectangular()->set_duration(duration);
  return impactor;
}

class Ratio : public testing::TestWithParam<std::uint32_t> {};

// A pulse that ends within a step: p t times the area of 2 m by 0.5 m, whatever the steps.
TEST_P(Ratio, HandsOverTheImpulseOfTheHistory) {
  Rig rig([](double) { return 0.0; }, GetParam());
  rig.run(rectangular(8.0, 0.2171));
  EXPECT_NEAR(rig.total(), -8.0 * 0.2171, round_off);
  const wire::Momentum& last = rig.reports.back().momentum();
  EXPECT_NEAR(last.interface_impulse(1), 8.0 * 0.2171, round_off);
  EXPECT_EQ(last.support_impulse(1), -last.interface_impulse(1));
  EXPECT_EQ(last.linear(1), 0.0);
}

// A constant pressure on a face that gives way by s does the work p A s, as far as its halves of steps are in.
TEST_P(Ratio, DoesTheWorkOfPressureTimesSweptVolume) {
  const auto height = [](double t) { return -0.5 * t * t; };
  Rig rig(height, GetParam());
  rig.run(rectangular(8.0, 100.0));
  const double swept = -height(60 * window);
  const wire::Energy& last = rig.reports.back().energy();
  EXPECT_EQ(last.interface_work(), -last.support_work());
  // Exact for a constant force but for the first half step, which pairs with the mean of rest and the velocity after
  // it: a quarter of the first window's work is missing, and that is 1/60^2 of all.
  EXPECT_NEAR(last.support_work(), 8.0 * swept, 8.0 * swept * 0.3 / (60.0 * 60.0));
}

INSTANTIATE_TEST_SUITE_P(StepsPerWindow, Ratio, testing::Values(1U, 2U, 5U));

TEST(PrescribedLoad, HasNoStepOfItsOwnAndNoParticles) {
  Rig rig([](double) { return 0.0; }, 1);
  rig.run(rectangular(1.0, 1.0));
  EXPECT_EQ(rig.ready.stable_step(), participant::no_step_limit);
  EXPECT_EQ(rig.ready.size(), 0U);
  EXPECT_EQ(rig.ready.scene_hash(), 7U);
}

TEST(PrescribedLoad, NoneGivesNothing) {
  scene::Impactor none;
  none.set_type(scene::Impactor::TYPE_NONE);
  Rig rig([](double t) { return -t; }, 1);
  rig.run(none);
  EXPECT_EQ(rig.forces.size(), 61U);
  EXPECT_EQ(rig.total(), 0.0);
  EXPECT_EQ(rig.reports.back().energy().support_work(), 0.0);
}

TEST(PrescribedLoad, RefusesASlug) {
  scene::Impactor slug;
  slug.set_type(scene::Impactor::TYPE_SLUG);
  Rig rig([](double) { return 0.0; }, 1);
  EXPECT_THROW(rig.run(slug), InputError);
}

}  // namespace
}  // namespace grainstep::fe
