// Restitution as the real engine returns it, for pairs and for particles on the structure.
#include <gtest/gtest.h>

#include <ostream>

#include "dem-service/damping.hpp"
#include "engine_rig.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

struct Case {
  double restitution;
  double steps_per_contact;
};

void PrintTo(const Case& c, std::ostream* out) { *out << "e=" << c.restitution << "_at_t_e/" << c.steps_per_contact; }

class Restitution : public testing::TestWithParam<Case> {};

constexpr int phases = 100;
constexpr double speed = 10.0;

wire::Setup setup_for(const Case& c) {
  wire::Setup setup = reference_setup();
  slug_of(setup).mutable_particle()->set_restitution(c.restitution);
  set_flat_surface(setup, 1.0, 40);
  return setup;
}

/// Steps until even the last collision is over: three contact times of a particle on the structure.
std::uint64_t enough(const SlugModel& model, double dt) {
  return static_cast<std::uint64_t>(3.0 * contact_time(model.on_surface) / dt);
}

// The calibration averages over 400 phases of entry, this test over 100: the two means differ by less than 1e-3.
constexpr double phase_noise = 1e-3;

TEST_P(Restitution, OfAPairIsTheInput) {
  wire::Setup setup = setup_for(GetParam());
  const SlugModel model = model_of(setup);
  const double dt = model.contact_time / GetParam().steps_per_contact;
  std::vector<PlacedParticle> particles;
  for (int i = 0; i < phases; ++i) {
    const double x = -0.9 + 0.015 * i;
    const double gap = 2.0 * speed * dt * (1.0 - (i + 0.5) / phases);
    particles.push_back({{{x, 0.5}}, {{speed, 0.0}}});
    particles.push_back({{{x + model.diameter + gap, 0.5}}, {{-speed, 0.0}}});
  }
  const ScriptedLink link = run(setup, start_of(dt, enough(model, dt)), particles);
  const wire::Field& velocity = field(link.snapshots.back(), "velocity");
  double mean = 0.0;
  for (int i = 0; i < phases; ++i) {
    EXPECT_DOUBLE_EQ(velocity.value(4 * i), -velocity.value(4 * i + 2));
    mean += velocity.value(4 * i + 2) / speed / phases;
  }
  EXPECT_NEAR(mean, GetParam().restitution, phase_noise);
}

TEST_P(Restitution, OnTheStructureIsTheInput) {
  wire::Setup setup = setup_for(GetParam());
  const SlugModel model = model_of(setup);
  const double dt = model.contact_time / GetParam().steps_per_contact;
  std::vector<PlacedParticle> particles;
  for (int i = 0; i < phases; ++i) {
    const double gap = speed * dt * (1.0 - (i + 0.5) / phases);
    particles.push_back({{{-0.9 + 0.015 * i, model.diameter / 2.0 + gap}}, {{0.0, -speed}}});
  }
  const ScriptedLink link = run(setup, start_of(dt, enough(model, dt)), particles);
  const wire::Field& velocity = field(link.snapshots.back(), "velocity");
  double mean = 0.0;
  for (int i = 0; i < phases; ++i) mean += velocity.value(2 * i + 1) / speed / phases;
  EXPECT_NEAR(mean, GetParam().restitution, phase_noise);
}

INSTANTIATE_TEST_SUITE_P(Inputs, Restitution,
                         testing::Values(Case{0.3, 10}, Case{0.7, 10}, Case{0.95, 10}, Case{0.3, 40}, Case{0.7, 40},
                                         Case{0.95, 40}));

}  // namespace
}  // namespace grainstep::dem
