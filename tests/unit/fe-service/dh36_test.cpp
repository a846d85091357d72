// The law of DH36 (3.3) and its return mapping at a point, against an independent bisection in plain scalar code.
#include "fe-service/materials/dh36.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fe-service/materials/radial_return.hpp"

namespace grainstep::fe {
namespace {

const Dh36 kSteel{Elastic::from_young(200e9, 0.3, 8000.0), 470e6, 1.5, 0.4, 0.015, 1.0};

/// (3.3) as it stands, with the floor of the rate factor.
double flow_strength(const Dh36& law, double strain, double rate) {
  const double hardening = 1.0 + law.hardening_factor * std::pow(strain, law.hardening_exponent);
  const double factor = rate > law.reference_rate ? 1.0 + law.rate_factor * std::log(rate / law.reference_rate) : 1.0;
  return law.yield_strength * hardening * factor;
}

double residual(const Dh36& law, double q_trial, double strain, double dt, double d) {
  return q_trial - 3.0 * law.elastic.mu * d - flow_strength(law, strain + d, d / dt);
}

double bisect(const Dh36& law, double q_trial, double strain, double dt) {
  double low = 0.0;
  double high = q_trial / (3.0 * law.elastic.mu);
  for (int i = 0; i < 2000 && high - low > 0.0; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (residual(law, q_trial, strain, dt, middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct Solved {
  double increment;
  double strength;
  int iterations;
};

/// The kernel's iteration, at one point; `last` is the increment of the step before, 0 if there was none.
Solved solve(const Dh36& law, double q_trial, double strain, double dt, double last = 0.0) {
  const double strength = strain > 0.0 ? law.static_strength(strain) : law.yield_strength;
  const double largest = largest_increment(law, q_trial, strength);
  double d = last > 0.0 ? std::min(last, largest) : first_increment(law, q_trial, strain, strength);
  double s = std::log(d);
  for (int i = 1; i <= kMaxReturnIterations; ++i) {
    const ReturnPoint point = return_step(law, q_trial, strain, std::log(dt * law.reference_rate), s, d);
    s += point.step;
    d *= std::exp(point.step);
    if (point.error <= kYieldTolerance * q_trial) return {d, point.static_strength, i};
  }
  ADD_FAILURE() << "no convergence: q " << q_trial << ", strain " << strain << ", dt " << dt << ", last " << last;
  return {0.0, 0.0, kMaxReturnIterations};
}

TEST(Dh36, PaperValues) {
  EXPECT_NEAR(kSteel.static_strength(1.0), 470e6 * 2.5, 1.0);
  EXPECT_NEAR(kSteel.static_strength(0.1), 470e6 * (1.0 + 1.5 * std::pow(0.1, 0.4)), 1.0);
  EXPECT_NEAR(kSteel.rate_multiplier(std::log(1e4)), 1.0 + 0.015 * std::log(1e4), 1e-15);
}

TEST(Dh36, RateFactorIsOneBelowTheReferenceRate) {
  EXPECT_EQ(kSteel.rate_multiplier(0.0), 1.0);
  EXPECT_EQ(kSteel.rate_multiplier(-10.0), 1.0);
}

/// What the tolerance of the residual is worth as plastic strain, and what bisection can tell apart.
double strain_tolerance(const Dh36& law, double q_trial, double exact) {
  return 1.01 * kYieldTolerance * q_trial / (3.0 * law.elastic.mu) + 1e-14 * exact;
}

/// Calls action(q_trial, strain, dt): fourteen decades of step length (below and above the reference rate), from virgin
/// to heavily worked material and from a grazing to a huge overshoot.
template <class Action>
void for_all_states(Action action) {
  for (const double strain : {0.0, 1e-9, 1e-6, 1e-3, 0.05, 1.0}) {
    for (double dt = 1e-9; dt < 1e5; dt *= 10.0) {
      for (const double overshoot : {1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0}) {
        action(flow_strength(kSteel, strain, 0.0) * (1.0 + overshoot), strain, dt);
      }
    }
  }
}

TEST(RadialReturn, AgreesWithBisection) {
  for_all_states([](double q, double strain, double dt) {
    const Solved found = solve(kSteel, q, strain, dt);
    const double exact = bisect(kSteel, q, strain, dt);
    EXPECT_NEAR(found.increment, exact, strain_tolerance(kSteel, q, exact))
        << "q " << q << " strain " << strain << " dt " << dt;
    const double strength = flow_strength(kSteel, strain + exact, 0.0);
    EXPECT_NEAR(found.strength, strength, 2.0 * kYieldTolerance * strength);
    EXPECT_LE(found.iterations, 20);
  });
}

// Whatever the last step has left behind, even of another state altogether, is only a start.
TEST(RadialReturn, AgreesWithBisectionFromAnyStart) {
  for_all_states([](double q, double strain, double dt) {
    const double exact = bisect(kSteel, q, strain, dt);
    for (const double factor : {1e-12, 1e-6, 1e-2, 0.5, 0.999, 1.001, 2.0, 1e3, 1e9}) {
      const Solved found = solve(kSteel, q, strain, dt, factor * exact);
      EXPECT_NEAR(found.increment, exact, strain_tolerance(kSteel, q, exact))
          << "q " << q << " strain " << strain << " dt " << dt << " start " << factor;
      EXPECT_LE(found.iterations, 30);
    }
  });
}

// In a run strain rates change by a few per cent from one step to the next: one evaluation or two.
TEST(RadialReturn, ANeighbouringStartNeedsTwoEvaluations) {
  for (const double strain : {1e-4, 1e-2, 0.2}) {
    for (const double increment : {1e-6, 1e-5, 1e-4}) {
      const double dt = 1e-7;
      const double q = flow_strength(kSteel, strain + increment, increment / dt) + 3.0 * kSteel.elastic.mu * increment;
      EXPECT_LE(solve(kSteel, q, strain, dt, 1.1 * increment).iterations, 2);
      EXPECT_LE(solve(kSteel, q, strain, dt, 0.9 * increment).iterations, 2);
      EXPECT_LE(solve(kSteel, q, strain, dt, 1.0005 * increment).iterations, 1);
    }
  }
}

// At first yield the hardening slope is infinite.
TEST(RadialReturn, FirstYieldNeedsFewIterations) {
  for (const double overshoot : {1e-9, 1e-7, 1e-5, 1e-3}) {
    const double q = kSteel.yield_strength * (1.0 + overshoot);
    EXPECT_LE(solve(kSteel, q, 0.0, 1e-7).iterations, 12) << overshoot;
  }
}

TEST(RadialReturn, HugeStep) {
  const double q = 1e4 * kSteel.yield_strength;
  const double exact = bisect(kSteel, q, 0.0, 1e-7);
  EXPECT_NEAR(solve(kSteel, q, 0.0, 1e-7).increment, exact, 1e-9 * exact);
}

TEST(RadialReturn, WithoutHardeningAndRateItIsTheClosedForm) {
  Dh36 perfect = kSteel;
  perfect.hardening_factor = 0.0;
  perfect.rate_factor = 0.0;
  for (const double overshoot : {1e-6, 1e-2, 5.0}) {
    const double expected = perfect.yield_strength * overshoot / (3.0 * perfect.elastic.mu);
    const double q = perfect.yield_strength * (1.0 + overshoot);
    EXPECT_NEAR(solve(perfect, q, 0.1, 1e-7).increment, expected, 1.01e-10 * q / (3.0 * perfect.elastic.mu));
  }
}

TEST(RadialReturn, LinearHardeningIsTheClosedForm) {
  Dh36 linear = kSteel;
  linear.hardening_exponent = 1.0;
  linear.rate_factor = 0.0;
  const double q = 2.0 * linear.yield_strength;
  const double slope = linear.yield_strength * linear.hardening_factor;
  const double expected = (q - linear.yield_strength) / (3.0 * linear.elastic.mu + slope);
  EXPECT_NEAR(solve(linear, q, 0.0, 1e-7).increment, expected, 1e-9 * expected);
}

}  // namespace
}  // namespace grainstep::fe
