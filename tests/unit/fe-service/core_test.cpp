// The law of sandwich cores (3.4) to (3.9) at a point: the analytic one-dimensional response, the conditions that an
// implicit step must meet, and a body of it in the element loop.
#include "fe-service/materials/core.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../../support/fe_block.hpp"
#include "fe-service/layers.hpp"

namespace grainstep::fe {
namespace {

/// rho_c/rho_m = 0.1, s_c = 0.11.
Core make_law(double poisson = 0.25, double viscosity = 6e3) {
  return {Elastic::from_young(20e9, poisson, 800.0), 0.011 * 470e6, -std::log(0.15), 20e9, viscosity, 0.011 * 470e6};
}

struct Point {
  Stress stress{0.0, 0.0, 0.0, 0.0};
  double compaction = 0.0;
  int sweeps = 0;
};

/// One step of the kernel, at one point in the material frame.
Point update(const Core& law, const Point& before, const StrainIncrement& strain, double step) {
  const Stress change = law.elastic.increment(strain);
  const Stress trial = {before.stress.xx + change.xx, before.stress.yy + change.yy, before.stress.xy + change.xy,
                        before.stress.zz + change.zz};
  const double drag = law.viscosity / step;
  CoreFlowIncrement x{0.0, 0.0, 0.0, shear_increment(law, trial.xy, drag)};
  int sweeps = 0;
  if (core_overshoot(law, trial, before.compaction) > 0.0) {
    while (sweep_core(law, trial, before.compaction, drag, x) > kCoreTolerance * core_scale(law, trial)) {
      if (++sweeps == kMaxCoreSweeps) ADD_FAILURE() << "no convergence";
      if (sweeps >= kMaxCoreSweeps) break;
    }
  }
  return {relaxed(law, trial, x), before.compaction - x.yy, sweeps};
}

/// Compression at a constant rate of total strain of one component without Poisson effect: stress (positive) and
/// compaction, elastic up to sigma_c, then with an overstress o that relaxes towards its steady value:
///     plateau:       do/dt = E rate - E o/eta            densified:  do/dt = E rate - (E + E_t) o/eta
struct Analytic {
  const Core& law;
  double rate;

  [[nodiscard]] double young() const { return law.elastic.longitudinal_modulus(); }
  [[nodiscard]] double stress(double time) const {
    const double yield = law.strength / (young() * rate);
    if (time <= yield) return young() * rate * time;
    const double dense = densification();
    if (time <= dense) return law.strength + overstress(time - yield, 0.0, young());
    const double stiff = young() + law.tangent;
    const double at_dense = overstress(dense - yield, 0.0, young());
    const double since = time - dense;
    const double over = overstress(since, at_dense, stiff);
    return law.strength + over + law.tangent * flow(since, at_dense, stiff);
  }
  /// o after `time`, relaxing with the stiffness k from o0.
  [[nodiscard]] double overstress(double time, double o0, double k) const {
    const double steady = young() * rate * law.viscosity / k;
    return steady + (o0 - steady) * std::exp(-k * time / law.viscosity);
  }
  /// Integral of o/eta.
  [[nodiscard]] double flow(double time, double o0, double k) const {
    const double steady = young() * rate * law.viscosity / k;
    return (steady * time + (o0 - steady) * law.viscosity / k * -std::expm1(-k * time / law.viscosity)) / law.viscosity;
  }
  /// When the compaction reaches c_D.
  [[nodiscard]] double densification() const {
    const double yield = law.strength / (young() * rate);
    double low = 0.0;
    double high = 1.0;
    while (flow(high, 0.0, young()) < law.densified) high *= 2.0;
    for (int i = 0; i < 200; ++i)
      (flow(0.5 * (low + high), 0.0, young()) < law.densified ? low : high) = 0.5 * (low + high);
    return yield + low;
  }
};

class CoreRate : public testing::TestWithParam<double> {};

// From below yield to 1.5 times the densification strain. Discretisation: within about half of what a step strains
// elastically, which falls with the step: first order, at steps from 1e-2 of the relaxation time to 1e6 of it.
TEST_P(CoreRate, OneDimensionalResponseIsTheAnalyticOne) {
  const Core law = make_law(0.0);
  const Analytic exact{law, GetParam()};
  const double end = 1.5 * law.densified + exact.law.strength / exact.young();
  for (const int steps : {200, 2000, 20000}) {
    const double step = end / steps / GetParam();
    Point point;
    double error = 0.0;
    for (int n = 1; n <= steps; ++n) {
      point = update(law, point, {0.0, -end / steps, 0.0, 0.0}, step);
      error = std::max(error, std::abs(-point.stress.yy - exact.stress(n * step)));
    }
    EXPECT_LT(error, 0.6 * exact.young() * end / steps) << steps;
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, CoreRate, testing::Values(1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6));

TEST(Core, ElasticBelowTheStrength) {
  const Core law = make_law();
  const StrainIncrement strain = {1e-5, -1e-5, 2e-5, 0.0};
  const Stress expected = law.elastic.increment(strain);
  const Point found = update(law, {}, strain, 1e-7);
  EXPECT_EQ(found.stress.yy, expected.yy);
  EXPECT_EQ(found.stress.xy, expected.xy);
  EXPECT_EQ(found.compaction, 0.0);
}

/// Misfit of x_i eta/dt = <|s_i| - Y_i> sign(s_i), as a stress.
double misfit(double s, double strength, double x, double drag) {
  if (drag > 0.0) return std::abs(x * drag - beyond(s, strength));
  const double outside = std::max(0.0, std::abs(s) - strength);
  const double idle = x == 0.0 ? 0.0 : std::abs(std::abs(s) - strength) + (x * s > 0.0 ? 0.0 : 1.0);
  return std::max(outside, idle);
}

// What (3.6) asks of an implicit step, for any trial stress up to 1e4 strengths, any compaction, and viscosities from
// none to one that lets nothing flow.
TEST(Core, EveryStepMeetsTheFlowRule) {
  std::mt19937 random(11);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / std::mt19937::max();
  };
  int most = 0;
  for (int trial_number = 0; trial_number < 20000; ++trial_number) {
    const double drag_time = trial_number % 4 == 0 ? 0.0 : std::pow(10.0, uniform(-6.0, 6.0));
    const Core law = make_law(uniform(-0.3, 0.4), drag_time);
    const double size = law.strength * std::pow(10.0, uniform(-1.0, 4.0));
    const Stress trial = {size * uniform(-1, 1), size * uniform(-1, 1), size * uniform(-1, 1), size * uniform(-1, 1)};
    const double compaction = uniform(-0.5, 3.0);
    Point before;
    before.stress = trial;
    before.compaction = compaction;
    const Point after = update(law, before, {0.0, 0.0, 0.0, 0.0}, 1.0);
    most = std::max(most, after.sweeps);
    const Elastic& c = law.elastic;
    // x = C^-1 (trial - s)
    const double mean_change = (trial.xx - after.stress.xx + trial.yy - after.stress.yy + trial.zz - after.stress.zz) /
                               (3.0 * c.lambda + 2.0 * c.mu);
    const double xx = (trial.xx - after.stress.xx - c.lambda * mean_change) / (2.0 * c.mu);
    const double zz = (trial.zz - after.stress.zz - c.lambda * mean_change) / (2.0 * c.mu);
    const double yy = compaction - after.compaction;
    const double tolerance = 1e-9 * core_scale(law, trial);
    if (law.viscosity > 0.0) {
      // Of x that is recovered from a difference of stresses only its round-off times the drag is known.
      const double known = tolerance * (1.0 + 1e-5 * law.viscosity / c.mu);
      EXPECT_NEAR(xx * law.viscosity, beyond(after.stress.xx, law.strength), known);
      EXPECT_NEAR(zz * law.viscosity, beyond(after.stress.zz, law.strength), known);
    } else {
      EXPECT_LE(std::abs(after.stress.xx), law.strength + tolerance);
      EXPECT_LE(std::abs(after.stress.zz), law.strength + tolerance);
      EXPECT_GE(xx * after.stress.xx, -1e-12 * core_scale(law, trial));
    }
    const double transverse = law.strength + densified_strength(law, yy < 0.0 ? after.compaction : compaction);
    EXPECT_LE(misfit(after.stress.yy, transverse, yy, law.viscosity),
              tolerance * (1.0 + (yy == 0.0 ? 0.0 : 1e-5 * law.viscosity / c.mu)));
  }
  EXPECT_LE(most, 120);
}

// A cell that is pulled open again crushes at its plateau, not at the densified strength.
TEST(Core, TensionUndoesCompaction) {
  const Core law = make_law(0.0, 0.0);
  Point point;
  for (int n = 0; n < 1000; ++n) point = update(law, point, {0.0, -2.0e-3, 0.0, 0.0}, 1.0);
  EXPECT_GT(point.compaction, law.densified);
  EXPECT_GT(-point.stress.yy, 2.0 * law.strength);
  for (int n = 0; n < 500; ++n) point = update(law, point, {0.0, 2.0e-3, 0.0, 0.0}, 1.0);
  EXPECT_LT(point.compaction, law.densified);
  EXPECT_NEAR(point.stress.yy, law.strength, 1e-9 * law.strength);
}

// On every instruction set: the point's law, in every triangle, while the block is crushed and sheared homogeneously;
// and again while it turns.
class CoreBody : public testing::TestWithParam<const Kernels*> {};

TEST_P(CoreBody, CrushingTurnsWithTheBody) {
  const Core law = make_law();
  const double step = 1e-7;
  const int steps = 400;
  for (const double turns : {0.0, 0.3}) {
    Body body = test::block_of(law, *GetParam());
    Point point;
    double work = 0.0;
    double expected_work = 0.0;
    double height = 1.0;
    double area = 0.0;
    for (int n = 1; n <= steps; ++n) {
      const double angle = 2.0 * M_PI * turns * n / steps;
      const double next = 1.0 - 0.9 * n / steps;
      test::crush_and_turn(body, next, angle, step);
      body.drift(step);
      const SweepResult result = body.sweep(step);
      EXPECT_EQ(result.unconverged, 0);
      work += result.plastic_work;
      const Stress before = point.stress;
      const double compaction = point.compaction;
      point = update(law, point, {0.0, 2.0 * (next - height) / (next + height), 0.0, 0.0}, step);
      area = test::block_width * test::block_height * 0.5 * (next + height);
      // Plastic increments from the differences of strain and stress.
      const Stress change = {point.stress.xx - before.xx, point.stress.yy - before.yy, 0.0,
                             point.stress.zz - before.zz};
      const double sum = (change.xx + change.yy + change.zz) / (3.0 * law.elastic.lambda + 2.0 * law.elastic.mu);
      const double plastic_xx = -(change.xx - law.elastic.lambda * sum) / (2.0 * law.elastic.mu);
      expected_work += area * 1e-3 *
                       (0.5 * (before.yy + point.stress.yy) * (compaction - point.compaction) +
                        (before.xx + point.stress.xx) * plastic_xx);
      height = next;
    }
    const double angle = 2.0 * M_PI * turns;
    const Stress expected = turned(point.stress, std::cos(2.0 * angle), std::sin(2.0 * angle));
    // Discretisation: gradients in the middle of a step that also turns see cos(pi turns/steps) of the body.
    const double tolerance = turns == 0.0 ? 1e-9 : 2e-4;
    test::expect_stress(body, expected, tolerance * von_mises(expected));
    test::expect_plastic_strain(body, point.compaction, tolerance);
    EXPECT_GT(point.compaction, law.densified);
    EXPECT_NEAR(work, expected_work, (turns == 0.0 ? 1e-8 : 1e-3) * expected_work);
  }
}

// Shear of the core does nothing to its transverse strength, and ends at its own, sigma_c or what an option makes of
// it.
TEST_P(CoreBody, ShearEndsAtItsStrength) {
  for (const double ratio : {1.0, 0.5}) {
    Core law = make_law(0.25, 0.0);
    law.shear = ratio * law.strength;
    Body body = test::block_of(law, *GetParam());
    const double step = 1e-6;
    for (int n = 1; n <= 100; ++n) {
      test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
        nodes.u[i] = (nodes.x0[i] + 2e-4 * n * nodes.y0[i] - nodes.x[i]) / step;
        nodes.v[i] = 0.0;
      });
      body.drift(step);
      body.sweep(step);
    }
    // The material frame has turned by half the shear angle, 0.01.
    const Stress found = turned(body.stress(1, 3, 1), std::cos(0.02), std::sin(0.02));
    EXPECT_NEAR(found.xy, law.shear, 1e-3 * law.strength);
    EXPECT_NEAR(body.plastic_strain(1, 3, 1), 0.0, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, CoreBody, testing::ValuesIn(available_kernels().begin(), available_kernels().end()),
                         [](const auto& which) { return std::string(which.param->name); });

}  // namespace
}  // namespace grainstep::fe
