// Contact with surfaces of every shape, through the real engine: forces without jumps, energy kept by elastic contacts
// with an order in the step, momentum and moment passed on exactly.
#include <gtest/gtest.h>

#include "bends.hpp"

namespace grainstep::dem {
namespace {

using namespace shapes;

/// What many copies make of an elastic contact.
struct Quality {
  double energy = 0.0;     ///< root mean square of energy lost or won, over the larger of before and after
  double direction = 0.0;  ///< largest change of the force from one step to the next, over the largest force
  double size = 0.0;       ///< likewise, of its size
};

Quality quality_of(Experiment experiment, double steps_per_contact) {
  experiment.steps_per_contact = steps_per_contact;
  const Result result = carry_out(experiment);
  Quality quality;
  double largest = 0.0;
  for (const Outcome& copy : result.copies) {
    EXPECT_GT(norm(copy.impulse), 0.0);
    EXPECT_EQ(norm(copy.force.back()), 0.0) << "still in contact";
    const double before = energy(result, copy.before);
    const double after = energy(result, copy.after);
    quality.energy += std::pow((after - before + copy.work) / std::max(before, after), 2) / copy_count;
    for (std::size_t n = 1; n < copy.force.size(); ++n) {
      const Vec2& now = copy.force[n];
      const Vec2& last = copy.force[n - 1];
      quality.direction = std::max(quality.direction, norm(now - last));
      quality.size = std::max(quality.size, std::abs(norm(now) - norm(last)));
      largest = std::max(largest, norm(now));
    }
  }
  return {std::sqrt(quality.energy), quality.direction / largest, quality.size / largest};
}

/// Order of the fall from the first to the last of some values, found with steps that halve.
double order_of(const std::vector<double>& values) {
  return std::log2(values.front() / values.back()) / static_cast<double>(values.size() - 1);
}

struct Expectation {
  double energy_order, energy_tolerance;  ///< relative, of the order
  double energy_at_10;                    ///< largest root mean square at t_e/10
};

/// Energy lost or won at about that step. How much depends also on where in a step the contact ends, and so on the part
/// of a step by which its duration exceeds a whole number of them: mean over steps a little smaller, too.
double energy_at(const Experiment& experiment, double steps_per_contact) {
  double sum = 0.0;
  for (const double finer : {1.0, 1.05, 1.10, 1.15, 1.20, 1.25}) {
    sum += std::pow(quality_of(experiment, finer * steps_per_contact).energy, 2) / 6.0;
  }
  return std::sqrt(sum);
}

/// Energy and force over steps of t_e/10 to t_e/160.
void check_quality(const std::string& name, const Experiment& experiment, const Expectation& expected,
                   double Quality::*jump, const std::string& jump_name) {
  std::vector<double> step;
  std::vector<double> lost;
  std::vector<double> jumps;
  for (const double steps : {10.0, 20.0, 40.0, 80.0, 160.0}) {
    const Quality quality = quality_of(experiment, steps);
    step.push_back(1.0 / steps);
    lost.push_back(energy_at(experiment, steps));
    jumps.push_back(quality.*jump);
  }
  verification::check(row(name, "energy lost or won (root mean square of 360 contacts) at t_e/10", 0.0, lost[0],
                          expected.energy_at_10, "discretisation: entry and leave between steps"));
  verification::check(row(name, "order of that energy, t_e/10 to t_e/160", expected.energy_order, order_of(lost),
                          expected.energy_tolerance, "discretisation: sixty phases of entry, six of leaving"));
  verification::check(row(name,
                          "order of the largest change of the force's " + jump_name + " in a step, t_e/40 to t_e/160",
                          1.0, order_of({jumps[2], jumps[3], jumps[4]}), 0.1,
                          "discretisation: a force without jumps changes in proportion to the step"));
  verification::curve({.group = "contact",
                       .name = name,
                       .title = name,
                       .x_label = "dt / t_e",
                       .y_label = "",
                       .axes = verification::Curve::Axes::log_log,
                       .series = {{"energy lost or won / energy", step, lost, {}},
                                  {"change of the force's " + jump_name + " / largest force", step, jumps, {}}}});
}

TEST(ContactShapes, FlatJoint) {
  check_quality("a joint in a flat surface", across(0.0), {2.0, 0.1, 1e-3}, &Quality::direction, "vector");
}

TEST(ContactShapes, ConvexCorner) {
  for (const int degrees : {11, 90, 150}) {
    check_quality("a convex corner of " + std::to_string(degrees) + " degrees", across(-degrees), {2.0, 0.1, 1e-3},
                  &Quality::direction, "vector");
  }
}

// The potential has a valley where both legs are equally near: the force turns at once, from one leg's normal to the
// other's, its size does not jump. A step that crosses the valley kicks along the old normal up to its end: first
// order.
TEST(ContactShapes, ConcaveFold) {
  for (const int degrees : {11, 45, 90}) {
    check_quality("a fold of " + std::to_string(degrees) + " degrees", across(degrees),
                  {1.0, 0.15,
                   degrees < 20   ? 0.01
                   : degrees < 60 ? 0.03
                                  : 0.08},
                  &Quality::size, "size");
  }
}

// Over the chord there is no valley: both legs press, each with its part in the particle.
TEST(ContactShapes, FoldOverTheChord) {
  check_quality("a fold of 45 degrees, over the chord", over_chord(across(45, 20)), {2.0, 0.2, 2e-2},
                &Quality::direction, "vector");
}

TEST(ContactShapes, CornerOverTheChord) {
  check_quality("a convex corner of 90 degrees, over the chord", over_chord(across(-90, 20)), {2.0, 0.2, 2e-2},
                &Quality::direction, "vector");
}

TEST(ContactShapes, TurningAndStretchingSegment) {
  check_quality("a segment that turns and stretches", on_turning_segment(), {2.0, 0.1, 2e-2}, &Quality::direction,
                "vector");
}

}  // namespace
}  // namespace grainstep::dem
