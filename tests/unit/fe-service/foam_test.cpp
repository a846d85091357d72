// The law of a foam projectile (4.7) to (4.12) at a point: closed forms on straight paths, the conditions that an
// implicit step must meet, and a body of it in the element loop.
#include "fe-service/materials/foam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <random>

#include "../../support/fe_block.hpp"
#include "fe-service/layers.hpp"

namespace grainstep::fe {
namespace {

/// The reference slug's foam.
Foam make_law(double poisson = 0.25, double viscosity = 2.5e3) {
  return {Elastic::from_young(9.48e9, poisson, 540.0), 0.864e6, std::log(4.5), viscosity};
}

struct Point {
  Stress stress{0.0, 0.0, 0.0, 0.0};
  double strain = 0.0;
  int iterations = 0;
};

double s_hat(const Stress& s) { return std::sqrt(contract(s, s)); }

/// One step of the kernel, at one point.
Point update(const Foam& law, const Point& before, const StrainIncrement& strain, double step) {
  const Stress change = law.elastic.increment(strain);
  const Stress trial = {before.stress.xx + change.xx, before.stress.yy + change.yy, before.stress.xy + change.xy,
                        before.stress.zz + change.zz};
  const FoamStress size = foam_stress(trial);
  if (foam_overshoot(law, size, before.strain) <= 0.0) return {trial, before.strain, 0};
  const double room = law.locked - before.strain;
  double x = 0.0;
  int iterations = 0;
  for (FoamIteration at{x, 1.0}; at.miss > kFoamTolerance && iterations < kMaxFoamIterations; ++iterations) {
    at = foam_step(law, size, law.viscosity / step, x);
    x = at.x;
  }
  for (FoamIteration at{x, 1.0}; at.miss > kFoamTolerance && iterations < kMaxFoamIterations; ++iterations) {
    at = foam_lock_step(law, size, room, x);
    x = at.x;
  }
  EXPECT_LT(iterations, kMaxFoamIterations) << "no convergence";
  const Stress now = relaxed(law, trial, x);
  const double increment = x * s_hat(now);
  return {now, increment > (1.0 - 1e-9) * room ? law.locked : before.strain + increment, iterations};
}

/// A path along which the stress keeps its direction: s_hat grows with `modulus` times the rate of the strain's length,
/// elastic up to s_pl; then with an overstress that relaxes towards eta times the rate; elastic again once locked.
struct Path {
  const char* name;
  StrainIncrement direction;  ///< of unit length
  double modulus;
};

Path path_of(const Foam& law, int which) {
  const double third = 1.0 / std::sqrt(3.0);
  const double half = std::sqrt(0.5);
  const Elastic& e = law.elastic;
  if (which == 0) return {"uniaxial", {0.0, -1.0, 0.0, 0.0}, e.longitudinal_modulus()};  // without Poisson's effect
  if (which == 1) return {"hydrostatic", {-third, -third, 0.0, -third}, 3.0 * e.lambda + 2.0 * e.mu};
  return {"shear", {0.0, 0.0, 2.0 * half, 0.0}, 2.0 * e.mu};
}

double closed_form(const Foam& law, const Path& path, double rate, double time) {
  const double yield = law.strength / (path.modulus * rate);
  if (time <= yield) return path.modulus * rate * time;
  const double relaxation = law.viscosity / path.modulus;
  const auto overstress = [&](double t) { return law.viscosity * rate * -std::expm1(-t / relaxation); };
  const auto flow = [&](double t) { return rate * (t - relaxation * -std::expm1(-t / relaxation)); };
  double low = 0.0;
  double high = 10.0 * (law.locked / rate + relaxation);
  for (int i = 0; i < 200; ++i) (flow(0.5 * (low + high)) < law.locked ? low : high) = 0.5 * (low + high);
  if (time - yield <= low) return law.strength + overstress(time - yield);
  return law.strength + overstress(low) + path.modulus * rate * (time - yield - low);
}

struct Case {
  int path;
  double rate;
};

void PrintTo(const Case& one, std::ostream* out) { *out << "path " << one.path << " at " << one.rate << "/s"; }

class FoamPath : public testing::TestWithParam<Case> {};

// From below yield to 1.3 times the locking strain. Discretisation: what a step strains elastically.
TEST_P(FoamPath, StressIsThatOfTheClosedForm) {
  const auto [which, rate] = GetParam();
  const Foam law = make_law(which == 0 ? 0.0 : 0.25);
  const Path path = path_of(law, which);
  for (const int steps : {200, 2000, 20000}) {
    const double length = 1.3 * law.locked / steps;
    const StrainIncrement strain = {length * path.direction.xx, length * path.direction.yy,
                                    length * path.direction.gamma, length * path.direction.zz};
    Point point;
    double error = 0.0;
    for (int n = 1; n <= steps; ++n) {
      point = update(law, point, strain, length / rate);
      error = std::max(error, std::abs(s_hat(point.stress) - closed_form(law, path, rate, n * length / rate)));
    }
    EXPECT_LT(error, 0.6 * path.modulus * length) << path.name << ", " << steps;
    EXPECT_EQ(point.strain, law.locked);
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (int path = 0; path < 3; ++path) {
    for (double rate = 1.0; rate < 2e6; rate *= 10.0) cases.push_back({path, rate});
  }
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Rates, FoamPath, testing::ValuesIn(all_cases()));

TEST(Foam, ElasticBelowTheStrength) {
  const Foam law = make_law();
  const StrainIncrement strain = {1e-5, -2e-5, 2e-5, 0.0};
  const Stress expected = law.elastic.increment(strain);
  const Point found = update(law, {}, strain, 1e-7);
  EXPECT_EQ(found.stress.yy, expected.yy);
  EXPECT_EQ(found.strain, 0.0);
}

TEST(Foam, PlasticPoissonRatioIsNil) {
  const Foam law = make_law(0.25, 0.0);
  Point point;
  for (int n = 0; n < 1000; ++n) point = update(law, point, {0.0, -1e-3, 0.0, 0.0}, 1.0);
  EXPECT_NEAR(point.stress.yy, -law.strength, 1e-9 * law.strength);
  EXPECT_NEAR(point.stress.xx, 0.0, 1e-9 * law.strength);
  EXPECT_NEAR(point.strain, 1.0 - law.strength / 9.48e9, 1e-4);
}

// Strength is infinite once the plateau is used up, whichever way it was used.
TEST(Foam, LockedIsElasticInTensionAndShearToo) {
  const Foam law = make_law(0.25, 0.0);
  Point point;
  point.strain = law.locked;
  for (const StrainIncrement& strain : {StrainIncrement{0.0, 0.1, 0.0, 0.0}, StrainIncrement{0.0, -0.3, 0.2, 0.0}}) {
    const Stress change = law.elastic.increment(strain);
    const Point next = update(law, point, strain, 1.0);
    EXPECT_EQ(next.stress.yy, point.stress.yy + change.yy);
    EXPECT_EQ(next.stress.xy, point.stress.xy + change.xy);
    EXPECT_EQ(next.strain, law.locked);
    point = next;
  }
}

// Any trial stress up to 1e5 strengths, any place on the plateau, viscosities from none to one that lets nothing flow:
// the flow rule or the end of the plateau, flow along the stress, and work that is not negative.
TEST(Foam, EveryStepMeetsTheFlowRule) {
  std::mt19937 random(5);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / std::mt19937::max();
  };
  int most = 0;
  int locked = 0;
  for (int trial_number = 0; trial_number < 20000; ++trial_number) {
    const double viscosity = trial_number % 4 == 0 ? 0.0 : std::pow(10.0, uniform(3.0, 15.0));
    const Foam law = make_law(uniform(-0.5, 0.45), viscosity);
    const double size = law.strength * std::pow(10.0, uniform(-1.0, 5.0));
    Point before;
    before.stress = {size * uniform(-1, 1), size * uniform(-1, 1), size * uniform(-1, 1), size * uniform(-1, 1)};
    before.strain = law.locked * (trial_number % 3 == 0 ? 1.0 - std::pow(10.0, uniform(-12, 0)) : uniform(0, 1));
    const Point after = update(law, before, {0.0, 0.0, 0.0, 0.0}, 1.0);
    most = std::max(most, after.iterations);
    const double flow = after.strain - before.strain;
    EXPECT_GE(flow, 0.0);
    EXPECT_LE(after.strain, law.locked);
    const double strength = law.strength + viscosity * flow;
    if (after.strain == law.locked) {
      ++locked;
      EXPECT_GE(s_hat(after.stress), strength * (1.0 - 1e-6));
    } else if (flow > 0.0) {
      EXPECT_NEAR(s_hat(after.stress), strength, 1e-9 * strength + viscosity * 1e-15);
    } else {
      EXPECT_LE(s_hat(after.stress), law.strength * (1.0 + 1e-12));
    }
    // trial - C : (flow s/s_hat) = s
    const double x = flow / s_hat(after.stress);
    const Stress back = law.elastic.increment(
        {x * after.stress.xx, x * after.stress.yy, 2.0 * x * after.stress.xy, x * after.stress.zz});
    const double known = 1e-9 * s_hat(before.stress) + 1e11 * 1e-15;
    EXPECT_NEAR(after.stress.xx + back.xx, before.stress.xx, known);
    EXPECT_NEAR(after.stress.yy + back.yy, before.stress.yy, known);
    EXPECT_NEAR(after.stress.xy + back.xy, before.stress.xy, known);
    EXPECT_NEAR(after.stress.zz + back.zz, before.stress.zz, known);
  }
  EXPECT_LE(most, 20);
  EXPECT_GT(locked, 100);
}

class FoamBody : public testing::TestWithParam<const Kernels*> {};

// On every instruction set: the point's law, in every triangle, while the block is crushed beyond locking; again while
// it turns. What is put in is what is stored and dissipated.
TEST_P(FoamBody, CrushingTurnsWithTheBodyAndKeepsEnergy) {
  const Foam law = make_law();
  const double step = 5e-8;
  const int steps = 2000;
  for (const double turns : {0.0, 0.3}) {
    Body body = test::block_of(law, *GetParam());
    Point point;
    double plastic = 0.0;
    double stored = 0.0;
    double put_in = 0.0;
    double height = 1.0;
    for (int n = 1; n <= steps; ++n) {
      const double angle = 2.0 * M_PI * turns * n / steps;
      const double next = 1.0 - 0.79 * n / steps;
      test::crush_and_turn(body, next, angle, step);
      body.drift(step);
      const SweepResult result = body.sweep(step);
      EXPECT_EQ(result.unconverged, 0);
      EXPECT_GE(result.plastic_work, 0.0);
      plastic += result.plastic_work;
      stored += result.stored;
      const double before = point.stress.yy;
      point = update(law, point, {0.0, 2.0 * (next - height) / (next + height), 0.0, 0.0}, step);
      put_in += 0.5 * (before + point.stress.yy) * (next - height) * test::block_width * test::block_height * 1e-3;
      height = next;
    }
    const double angle = 2.0 * M_PI * turns;
    const Stress expected = turned(point.stress, std::cos(2.0 * angle), std::sin(2.0 * angle));
    // Discretisation: gradients in the middle of a step that also turns see cos(pi turns/steps) of the body.
    const double tolerance = turns == 0.0 ? 1e-9 : 2e-4;
    test::expect_stress(body, expected, tolerance * s_hat(expected));
    test::expect_plastic_strain(body, point.strain, tolerance);
    EXPECT_EQ(point.strain, law.locked);
    EXPECT_NEAR(stored + plastic, put_in, tolerance * put_in);
  }
}

// What was stored is what is given back: below the strength, to a tenth of the height off and back, turning or not.
TEST_P(FoamBody, AnElasticCycleGivesBackWhatItStored) {
  Foam law = make_law();
  law.strength = 1e12;
  const double step = 5e-8;
  constexpr int half = 500;
  for (const double turns : {0.0, 0.3}) {
    Body body = test::block_of(law, *GetParam());
    double stored = 0.0;
    double most = 0.0;
    for (int n = 1; n <= 2 * half; ++n) {
      const double squeezed = 0.1 * (n <= half ? n : 2 * half - n) / half;
      test::crush_and_turn(body, 1.0 - squeezed, 2.0 * M_PI * turns * n / (2 * half), step);
      body.drift(step);
      const SweepResult result = body.sweep(step);
      EXPECT_EQ(result.plastic_work, 0.0);
      stored += result.stored;
      most = std::max(most, stored);
    }
    // As the stress, which a turn of half a radian in 1000 steps leaves by its discretisation.
    EXPECT_NEAR(stored, 0.0, (turns == 0.0 ? 1e-12 : 1e-6) * most);
    // Between both, by less than the third order of the strain: V s^2/2M by the present volume.
    const double volume = test::block_width * test::block_height * 1e-3;
    const double modulus = law.elastic.longitudinal_modulus();
    const double exact = volume * modulus * (0.9 * std::log(0.9) - 0.9 + 1.0);  // integral of M ln J dJ
    EXPECT_NEAR(most, exact, 1e-4 * exact);
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, FoamBody, testing::ValuesIn(available_kernels().begin(), available_kernels().end()),
                         [](const auto& which) { return std::string(which.param->name); });

}  // namespace
}  // namespace grainstep::fe
