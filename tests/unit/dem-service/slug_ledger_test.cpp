// A slug against rigid walls: the ledgers close.
#include <gtest/gtest.h>

#include "dem-service/slug/report.hpp"
#include "engine_rig.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

/// Initial kinetic energy and momentum of the slug, from its scene keys.
double energy_at_start(const SlugModel& model) {
  return 0.5 * model.mass * static_cast<double>(model.particles) * model.speed * model.speed;
}
double momentum_at_start(const SlugModel& model) {
  return model.mass * static_cast<double>(model.particles) * model.speed;
}

double total(const wire::Energy& e) {
  return e.kinetic() + e.elastic() + e.damping() + e.friction() - e.interface_work() - e.support_work();
}

struct Run {
  bool mirror = true;
  double steps_per_contact = 10.0;
  std::uint32_t steps_per_window = 1;
  Motion motion = at_rest();
  double slug_times = 0.4;  // of H/v0
};

ScriptedLink impact(const Run& what) {
  wire::Setup setup = reference_setup();
  setup.set_mirror(what.mirror);
  set_flat_surface(setup, 0.2, 60);
  const SlugModel model = model_of(setup);
  const double dt = model.contact_time / what.steps_per_contact;
  const auto windows =
      static_cast<std::uint64_t>(what.slug_times * model.height / model.speed / dt / what.steps_per_window);
  wire::Start start = start_of(dt, windows, what.steps_per_window);
  start.set_report_every(static_cast<double>(windows / 10));
  return run_slug(setup, start, what.motion);
}

double worst_drift(const ScriptedLink& link) {
  const double first = total(link.reports.front().energy());
  double worst = 0.0;
  for (const wire::Report& report : link.reports) {
    worst = std::max(worst, std::abs(total(report.energy()) - first) / first);
  }
  return worst;
}

constexpr double round_off = 1e-12;

void expect_momentum_closes(const ScriptedLink& link) {
  const wire::Momentum& first = link.reports.front().momentum();
  const double scale = std::abs(first.linear(1));
  for (const wire::Report& report : link.reports) {
    const wire::Momentum& now = report.momentum();
    for (int c = 0; c < 2; ++c) {
      const double change = now.linear(c) - first.linear(c);
      EXPECT_NEAR((change - now.interface_impulse(c) - now.support_impulse(c)) / scale, 0.0, round_off)
          << "window " << report.window();
    }
  }
  EXPECT_GT(link.reports.back().momentum().interface_impulse(1), 0.2 * scale);
}

TEST(SlugLedger, StartsWithTheSlugsOwnEnergyAndMomentum) {
  const ScriptedLink link = impact({.slug_times = 0.05});
  wire::Setup setup = reference_setup();
  setup.set_mirror(true);
  const SlugModel model = model_of(setup);
  EXPECT_EQ(model.particles, std::llround(0.2 * 0.02 * 0.04 / (3.14159265358979 / 4 * 1e-6)));
  EXPECT_NEAR(link.reports.front().energy().kinetic() / energy_at_start(model), 1.0, round_off);
  EXPECT_NEAR(link.reports.front().momentum().linear(1) / -momentum_at_start(model), 1.0, round_off);
}

TEST(SlugLedger, MomentumClosesToRoundOff) {
  expect_momentum_closes(impact({}));
  expect_momentum_closes(impact({.mirror = false}));
  expect_momentum_closes(impact({.steps_per_window = 4}));
}

TEST(SlugLedger, ImpulseHandedOverIsTheImpulseOfTheLedger) {
  const ScriptedLink link = impact({.steps_per_window = 3});
  double x2 = 0.0;
  for (const wire::Forces& forces : link.forces) {
    for (int i = 1; i < forces.impulse_size(); i += 2) x2 += forces.impulse(i);
  }
  // The last step's impulse is handed over whole, of which half lies behind t(n).
  const wire::Momentum& last = link.reports.back().momentum();
  EXPECT_NEAR(-x2 / last.interface_impulse(1), 1.0, 0.01);
  EXPECT_EQ(link.forces.size(), link.reports.back().window() + 1);
}

TEST(SlugLedger, EnergyCloses) {
  for (const bool mirror : {true, false}) {
    const ScriptedLink link = impact({.mirror = mirror});
    const wire::Energy& last = link.reports.back().energy();
    EXPECT_LT(last.kinetic(), 0.7 * link.reports.front().energy().kinetic());
    EXPECT_GT(last.damping(), 0.0);
    EXPECT_GT(last.friction(), 0.0);
    EXPECT_GT(last.elastic(), 0.0);
    EXPECT_LT(worst_drift(link), 0.01);  // 0.55% at t_e/10; its order: tests/convergence/dem_energy_order_test.cpp
  }
}

TEST(DissipationGuard, SpeaksUpWhenDissipationFalls) {
  DissipationGuard guard;
  wire::Energy energy;
  energy.set_kinetic(100.0);
  EXPECT_FALSE(guard.look(energy));
  energy.set_kinetic(20.0);  // the largest energy is the measure
  energy.set_friction(30.0);
  energy.set_damping(50.0);
  EXPECT_FALSE(guard.look(energy));
  energy.set_friction(29.95);
  EXPECT_FALSE(guard.look(energy));
  energy.set_friction(29.8);
  EXPECT_TRUE(guard.look(energy));
  energy.set_friction(31.0);
  EXPECT_FALSE(guard.look(energy));
  energy.set_damping(49.0);
  EXPECT_TRUE(guard.look(energy));
}

}  // namespace
}  // namespace grainstep::dem
