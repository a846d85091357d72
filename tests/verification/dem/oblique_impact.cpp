// Oblique impacts: rebound and spin over angle and spin of approach, against the same law as an ordinary differential
// equation and, where nothing is lost, against closed forms. The plan is that of tests 4 to 7 of Chung and Ooi
// (Granular Matter 13, 2011); their spheres are Hertzian, ours are discs with linear springs. Test 8 (two sizes) is in
// unequal_spin.cpp.
#include <gtest/gtest.h>

#include <numbers>

#include "contact_ode.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using namespace impacts;
using verification::Comparison;

constexpr double speed = 3.9;      // m/s, of test 4
constexpr double radius = 0.5e-3;  // m

/// One speed, angles from the normal of 5 to 85 degrees.
std::vector<Motion2> over_angles() {
  std::vector<Motion2> all;
  for (int degrees = 5; degrees < 90; degrees += 5) {
    const double angle = degrees * std::numbers::pi / 180.0;
    all.push_back({speed * std::cos(angle), speed * std::sin(angle), 0.0});
  }
  return all;
}

/// One approach speed, spins that make up to four times that speed at the rim.
std::vector<Motion2> over_spins() {
  std::vector<Motion2> all;
  for (double rim = -4.0; rim <= 4.0; rim += 0.5) all.push_back({speed, 0.0, rim * speed / radius});
  return all;
}

/// Largest error of any velocity of any impact, over the root of the sum of squares of that impact's velocities before.
double error_of(const std::vector<Motion2>& before, const std::vector<Motion2>& expected,
                const std::vector<Motion2>& found) {
  double worst = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double scale = std::hypot(before[i].normal, before[i].tangential, radius * before[i].spin);
    for (const double difference : {found[i].normal - expected[i].normal, found[i].tangential - expected[i].tangential,
                                    radius * (found[i].spin - expected[i].spin)}) {
      worst = verification::larger(worst, std::abs(difference) / scale);
    }
  }
  return worst;
}

/// Means over the phase of entry.
std::vector<Motion2> found_at(const Law& law, Partner partner, const std::vector<Motion2>& before, double steps) {
  std::vector<Motion2> all;
  for (const auto& phases : rebounds(law, partner, before, {.steps_per_contact = steps, .count = 10})) {
    all.push_back(mean_of(phases));
  }
  return all;
}

struct Plan {
  std::string name;
  std::string origin;
  Law law;
  Partner partner;
  std::vector<Motion2> before;
  std::string abscissa;
  double (*place)(const Motion2&);
};

double angle_of(const Motion2& motion) {
  return std::atan2(motion.tangential, motion.normal) * 180.0 / std::numbers::pi;
}
double rim_speed_of(const Motion2& motion) { return motion.spin * radius / speed; }

void plot(const Plan& plan, const std::vector<Motion2>& expected, const std::vector<Motion2>& found) {
  using verification::Series;
  Series spin_ode{"spin x radius / speed, ODE", {}, {}, Series::Mark::line};
  Series spin{"spin x radius / speed, t_e/10", {}, {}, Series::Mark::points};
  Series slide_ode{"tangential / speed, ODE", {}, {}, Series::Mark::line};
  Series slide{"tangential / speed, t_e/10", {}, {}, Series::Mark::points};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (Series* series : {&spin_ode, &spin, &slide_ode, &slide}) series->x.push_back(plan.place(plan.before[i]));
    spin_ode.y.push_back(rim_speed_of(expected[i]));
    spin.y.push_back(rim_speed_of(found[i]));
    slide_ode.y.push_back(expected[i].tangential / speed);
    slide.y.push_back(found[i].tangential / speed);
  }
  verification::curve({.group = "particles",
                       .name = plan.name,
                       .title = "after the impact",
                       .x_label = plan.abscissa,
                       .y_label = "",
                       .series = {slide_ode, slide, spin_ode, spin}});
}

void carry_out(const Plan& plan) {
  std::vector<Motion2> expected;
  const ContactOde ode(plan.law, plan.partner);
  for (const Motion2& before : plan.before) expected.push_back(ode.rebound(before));
  const std::vector<Motion2> coarse = found_at(plan.law, plan.partner, plan.before, 10.0);
  const double at_10 = error_of(plan.before, expected, coarse);
  const double at_160 = error_of(plan.before, expected, found_at(plan.law, plan.partner, plan.before, 160.0));
  Comparison c{
      .group = "particles",
      .name = plan.name,
      .quantity = "largest error of any velocity (rim speed of the spin included), over the impact's own, t_e/10",
      .unit = "",
      .reference = "ODE integration of (2.1), (2.2), Runge-Kutta of fourth order, t_e/4000",
      .origin = plan.origin,
      .expected = 0.0,
      .found = at_10,
      .tolerance = 0.08,
      .reason = "discretisation, first order: the spring takes the whole step's slip wherever in it the touch began"};
  verification::check(c);
  c.quantity = "the same at t_e/160";
  c.found = at_160;
  c.tolerance = 0.006;
  verification::check(c);
  plot(plan, expected, coarse);
}

const Law alumina{.restitution = 0.98, .friction = 0.092};
const Law sand{};
constexpr const char* origin_4 = "plan and constants (e = 0.98, mu = 0.092, 3.9 m/s) of Chung and Ooi 2011, test 4";
constexpr const char* origin_6 = "plan of Chung and Ooi 2011, tests 5 and 6; the scenes' e = 0.7, mu = 0.7";
constexpr const char* origin_7 = "plan of Chung and Ooi 2011, test 7; the scenes' e = 0.7, mu = 0.7";

TEST(ObliqueImpact, OnTheSurfaceOverTheAngle) {
  carry_out({"oblique impact on a surface, alumina", origin_4, alumina, Partner::surface, over_angles(),
             "angle from the normal (degrees)", angle_of});
  carry_out({"oblique impact on a surface, sand", "constants of the scenes: e = 0.7, mu = 0.7, Ks/Kn = 2/7", sand,
             Partner::surface, over_angles(), "angle from the normal (degrees)", angle_of});
}

TEST(ObliqueImpact, OfAPairOverTheAngle) {
  carry_out({"oblique impact of two particles", "constants of the scenes: e = 0.7, mu = 0.7, Ks/Kn = 2/7", sand,
             Partner::particle, over_angles(), "angle from the normal (degrees)", angle_of});
}

TEST(ObliqueImpact, OverTheSpin) {
  carry_out({"spinning particle on a surface", origin_6, sand, Partner::surface, over_spins(), "spin x radius / speed",
             rim_speed_of});
  carry_out({"two spinning particles", origin_7, sand, Partner::particle, over_spins(), "spin x radius / speed",
             rim_speed_of});
}

TEST(ObliqueImpact, ConvergesToTheOdeInFirstOrder) {
  for (const Partner partner : {Partner::surface, Partner::particle}) {
    std::vector<Motion2> expected;
    const ContactOde ode(sand, partner);
    for (const Motion2& before : over_angles()) expected.push_back(ode.rebound(before));
    std::vector<double> step;
    std::vector<double> error;
    for (const double steps : {10.0, 20.0, 40.0, 80.0}) {
      step.push_back(1.0 / steps);
      error.push_back(error_of(over_angles(), expected, found_at(sand, partner, over_angles(), steps)));
    }
    const std::string name = std::string("oblique impact with a ") + name_of(partner) + ", order";
    verification::check({.group = "convergence",
                         .name = name,
                         .quantity = "order of the largest error, t_e/20 to t_e/80",
                         .unit = "",
                         .reference = "first order",
                         .origin = "slip of the step of first touch: docs/theory/contact.md",
                         .expected = 1.0,
                         .found = 0.5 * std::log2(error[1] / error[3]),
                         .tolerance = 0.1,
                         .reason = "discretisation: higher order"});
    verification::curve({.group = "convergence",
                         .name = name,
                         .title = std::string("oblique impact with a ") + name_of(partner),
                         .x_label = "dt / t_e",
                         .y_label = "largest error / speed",
                         .axes = verification::Curve::Axes::log_log,
                         .series = {{"found", step, error, {}},
                                    {"first order",
                                     {step.front(), step.back()},
                                     {error[2] * step.front() / step[2], error[2] * step.back() / step[2]},
                                     verification::Series::Mark::line}}});
  }
}

/// What closed forms say of an elastic impact on the surface.
struct Regime {
  std::string name;
  Law law;
  Motion2 before;
  Motion2 after;
  double tolerance;
  std::string reason;
};

void check_regime(const Regime& regime) {
  const Motion2 found = found_at(regime.law, Partner::surface, {regime.before}, 640.0)[0];
  const auto compare = [&](const std::string& quantity, double expected, double measured) {
    verification::check({.group = "particles",
                         .name = "elastic oblique impact, " + regime.name,
                         .quantity = quantity,
                         .unit = "m/s",
                         .reference = "closed form",
                         .origin = "linear oscillator of slip; Coulomb impulse 2 mu m v_n; rigid rolling",
                         .expected = expected,
                         .found = measured,
                         .tolerance = regime.tolerance,
                         .reason = regime.reason});
  };
  compare("tangential velocity", regime.after.tangential, found.tangential);
  compare("spin x radius", radius * regime.after.spin, radius * found.spin);
  compare("normal velocity", regime.after.normal, found.normal);
}

/// A tangential impulse J changes the velocity by J/m, the rim's speed by 2 J/m, and the slip by 3 J/m.
Motion2 after_slip_change(const Motion2& before, double change) {
  return {before.normal, before.tangential + change / 3.0, before.spin + 2.0 * change / 3.0 / radius};
}

TEST(ObliqueImpact, ClosedFormsOfStickSlipAndRoll) {
  const Motion2 at_45{2.0, 2.0, 0.0};
  const Law sticking{.restitution = 1.0, .friction = 1000.0};
  // The slip swings as cos(omega_t t) with omega_t^2 = 3 Ks/m, for the time pi sqrt(m/Kn).
  const double swing = std::cos(std::numbers::pi * std::sqrt(3.0 * sticking.tangential_ratio));
  constexpr const char* first_order = "discretisation: t_e/640, first order";
  check_regime({"stick", sticking, at_45, after_slip_change(at_45, (swing - 1.0) * 2.0), 1e-3, first_order});
  const Motion2 grazing{1.0, 3.0, 0.0};
  const Law sliding{.restitution = 1.0, .friction = 0.1};
  check_regime({"slip", sliding, grazing, after_slip_change(grazing, -3.0 * 2.0 * 0.1 * 1.0), 1e-3, first_order});
  const Motion2 rolling{1.0, 3.0, -3.0 / radius};
  check_regime({"roll",
                {.restitution = 1.0},
                rolling,
                rolling,
                1e-6,
                "exact tangentially; discretisation of third order along the normal"});
}

}  // namespace
}  // namespace grainstep::dem
