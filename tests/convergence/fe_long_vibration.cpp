// A beam that swings freely for a million steps: its energy oscillates within the bound of central differences and goes
// nowhere.
#include <gtest/gtest.h>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

struct Million {
  double low = 1e300, high = 0.0;              ///< of all samples, J
  double first_tenth = 0.0, last_tenth = 0.0;  ///< means, J
  double start = 0.0;                          ///< J
};

Million swing(double speed) {
  constexpr int kSteps = 1'000'000, kEvery = 50, kTenth = kSteps / 10;
  Body body = test::body_of(test::beam(scene::Layer::MATERIAL_ELASTIC, 0.1, 0.02, 1));
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    nodes.v[i] = -0.5 * speed * (1.0 + std::cos(M_PI * nodes.x0[i] / 0.1));
  });
  Million result;
  result.start = kinetic_energy(body, Velocities::of(body));
  test::Stepper stepper(body, 0.9 * body.stable_step());
  for (int n = 0; n < kSteps; ++n) {
    const bool sampled = n % kEvery == kEvery - 1;
    const Velocities before = sampled ? Velocities::of(body) : Velocities{};
    const double elastic = sampled ? elastic_energy(body) : 0.0;
    stepper([&](Body& b) {
      (void)b.hold_supports();
      if (!sampled) return;
      const double energy = elastic + kinetic_energy(b, Velocities::blend(before, Velocities::of(b), 0.5));
      result.low = std::min(result.low, energy);
      result.high = std::max(result.high, energy);
      if (n < kTenth) result.first_tenth += energy * kEvery / kTenth;
      if (n >= kSteps - kTenth) result.last_tenth += energy * kEvery / kTenth;
    });
  }
  return result;
}

void check(double speed, const std::string& quantity, double found, double tolerance, const std::string& reason) {
  verification::Comparison result;
  result.group = "structure";
  result.name = "Free vibration over a million steps";
  result.quantity = "mid-span starts at " + std::to_string(static_cast<int>(speed)) + " m/s: " + quantity;
  result.reference = "conservation";
  result.origin =
      "kinetic + elastic energy, velocities in the middle between two steps; steps of 0.9 of the stable one";
  result.found = found;
  result.tolerance = tolerance;
  result.reason = reason;
  verification::check(result);
}

class FeLongVibration : public testing::TestWithParam<double> {};

TEST_P(FeLongVibration, EnergyDoesNotDrift) {
  const double speed = GetParam();
  const Million found = swing(speed);
  check(speed, "energy's largest excursion", std::max(found.high, 2.0 * found.start - found.low) / found.start - 1.0,
        1e-3, "discretisation: (omega dt)^2/8 of the modes that swing; it comes and goes");
  check(speed, "change of its mean from the first to the last tenth",
        (found.last_tenth - found.first_tenth) / found.start, 1e-6,
        "statistics: mean of 2000 samples of an oscillation of 6e-4; the same after four million steps");
}

INSTANTIATE_TEST_SUITE_P(Speeds, FeLongVibration, testing::Values(1.0, 10.0));

}  // namespace
}  // namespace grainstep::fe
