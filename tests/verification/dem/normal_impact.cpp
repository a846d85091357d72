// Head-on collisions: restitution over e and step, overlap, duration and force (tests 1 to 3 of Chung and Ooi, with
// linear springs instead of Hertz's and discs instead of spheres).
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "contact_ode.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using namespace impacts;
using verification::Comparison;

constexpr double speed = 10.0;
constexpr double restitutions[] = {0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99};
constexpr double steps_per_contact[] = {5.0, 10.0, 20.0, 50.0, 100.0};

/// Departure over approach speed of every phase of entry.
std::vector<double> measured(double restitution, Partner partner, double steps) {
  // Not a divisor of the calibration's 400 phases: other places are tried than those that it averages.
  const Phases phases{.steps_per_contact = steps, .count = 110};
  const auto after = rebounds({.restitution = restitution}, partner, {{speed, 0.0, 0.0}}, phases);
  std::vector<double> all;
  for (const Motion2& one : after[0]) all.push_back(one.normal / speed);
  return all;
}

double mean(const std::vector<double>& all) {
  double sum = 0.0;
  for (const double one : all) sum += one / static_cast<double>(all.size());
  return sum;
}

/// Half the way from the least to the most bouncing phase.
double scatter(const std::vector<double>& all) {
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  return 0.5 * (*most - *least);
}

Comparison restitution_of(Partner partner) {
  return {.group = "particles",
          .name = std::string("restitution of a head-on collision with a ") + name_of(partner),
          .quantity = "",
          .unit = "",
          .reference = "the scene's coefficient of restitution e",
          .origin =
              "(2.3), (2.4), calibrated for the discrete scheme: docs/theory/particles.md; Chung and Ooi 2011, test 3",
          .expected = 0.0,
          .found = 0.0,
          .tolerance = 0.0,
          .reason = ""};
}

void check_means(Partner partner, double steps) {
  double worst = 0.0;
  for (const double e : restitutions)
    worst = verification::larger(worst, std::abs(mean(measured(e, partner, steps)) - e));
  Comparison c = restitution_of(partner);
  c.quantity = "largest |mean e found - e| for e = 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99 at t_e/" +
               std::to_string(static_cast<int>(steps));
  c.found = worst;
  c.tolerance = 1e-3;
  c.reason = "statistics: 110 phases of entry against the 400 of the calibration";
  verification::check(c);
}

/// What the calibration leaves: a single collision depends on where in the step it begins.
void check_scatter(Partner partner) {
  std::vector<double> step;
  std::vector<double> found;
  for (const double steps : steps_per_contact) {
    step.push_back(1.0 / steps);
    found.push_back(scatter(measured(0.7, partner, steps)));
  }
  Comparison c = restitution_of(partner);
  c.quantity = "scatter of e with the phase of entry, e = 0.7 at t_e/10";
  c.found = found[1];
  c.tolerance = 0.04;
  c.reason = "discretisation: the dashpot acts for a whole step wherever in it the first touch lies";
  verification::check(c);
  c.quantity = "order of that scatter, t_e/20 to t_e/100";
  c.expected = 1.0;
  c.found = std::log(found[2] / found[4]) / std::log(5.0);
  c.tolerance = 0.1;
  c.reason = "discretisation: higher order";
  verification::check(c);
  verification::curve({.group = c.group,
                       .name = c.name,
                       .title = std::string("what remains with a ") + name_of(partner),
                       .x_label = "dt / t_e",
                       .y_label = "scatter of e with the phase of entry (e = 0.7)",
                       .axes = verification::Curve::Axes::log_log,
                       .series = {{"found", step, found, {}},
                                  {"first order",
                                   {step.front(), step.back()},
                                   {found[3] * step.front() / step[3], found[3] * step.back() / step[3]},
                                   verification::Series::Mark::line}}});
}

TEST(NormalImpact, RestitutionOfAPairIsTheInput) {
  for (const double steps : steps_per_contact) check_means(Partner::particle, steps);
  check_scatter(Partner::particle);
}

TEST(NormalImpact, RestitutionOnTheStructureIsTheInput) {
  for (const double steps : steps_per_contact) check_means(Partner::surface, steps);
  check_scatter(Partner::surface);
}

/// One particle on the surface, every step seen.
struct History {
  double dt;
  double largest_overlap = 0.0;  ///< m
  double duration = 0.0;         ///< s, from first to last force
  double largest_force = 0.0;    ///< N
  double off_spring = 0.0;       ///< N, largest |F - Kn delta|
};

History history_of(double restitution, double steps) {
  const wire::Setup setup = setup_of({.restitution = restitution});
  const SlugModel model = rig::model_of(setup);
  const double radius = model.diameter / 2.0;
  History result{.dt = model.contact_time / steps};
  wire::Start start = rig::start_of(result.dt, static_cast<std::uint64_t>(2.5 * steps));
  start.set_snapshot_every(1);
  const double gap = 0.5 * speed * result.dt;
  const rig::ScriptedLink link = rig::run(setup, start, {{{{0.0, radius + gap}}, {{0.0, -speed}}, 0.0}});
  for (std::size_t n = 1; n < link.snapshots.size(); ++n) {
    double force = 0.0;
    for (int i = 1; i < link.forces[n].impulse_size(); i += 2) force -= link.forces[n].impulse(i) / result.dt;
    const double overlap = std::max(0.0, radius - link.snapshots[n].position(1));
    result.largest_overlap = std::max(result.largest_overlap, overlap);
    result.largest_force = std::max(result.largest_force, force);
    result.off_spring = std::max(result.off_spring, std::abs(force - ContactOde::kn * overlap));
    if (force != 0.0) result.duration += result.dt;
  }
  return result;
}

Comparison normal_contact(const std::string& quantity, const std::string& unit, double expected, double found) {
  return {.group = "particles",
          .name = "overlap, duration and force of a head-on collision with a surface",
          .quantity = quantity,
          .unit = unit,
          .reference = "linear oscillator",
          .origin = "(2.1), (2.4); Chung and Ooi 2011, test 2 (theirs: Hertzian spheres)",
          .expected = expected,
          .found = found,
          .tolerance = 5e-3,
          .reason = "discretisation: t_e/400, first order"};
}

TEST(NormalImpact, OverlapDurationAndForce) {
  const double mass = rig::model_of(setup_of({})).mass;
  const double omega = std::sqrt(ContactOde::kn / mass);
  for (const double e : {1.0, 0.7, 0.3}) {
    const History found = history_of(e, 400.0);
    const double ratio = -std::log(e) / std::numbers::pi;  // zeta/sqrt(1 - zeta^2)
    const double damped = omega / std::sqrt(1.0 + ratio * ratio);
    const double to_the_turn = e < 1.0 ? std::atan(1.0 / ratio) : std::numbers::pi / 2.0;
    const std::string which = ", e = " + std::to_string(e).substr(0, 3);
    verification::check(normal_contact("largest overlap" + which, "m", speed / omega * std::exp(-ratio * to_the_turn),
                                       found.largest_overlap));
    verification::check(normal_contact("duration" + which, "s", std::numbers::pi / damped, found.duration));
  }
  const History elastic = history_of(1.0, 10.0);
  Comparison line = normal_contact("largest |F - Kn delta| over the largest F, e = 1, t_e/10", "", 0.0,
                                   elastic.off_spring / elastic.largest_force);
  line.tolerance = 1e-10;
  line.reason = "exact: round-off of a place, 1e-19 m, in an overlap of 1e-6 m";
  verification::check(line);
}

}  // namespace
}  // namespace grainstep::dem
