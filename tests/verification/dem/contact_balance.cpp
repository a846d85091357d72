// What contact hands to the surface, through the real engine: momentum and moment exactly, and the same whatever
// segments the surface is made of.
#include <gtest/gtest.h>

#include "bends.hpp"

namespace grainstep::dem {
namespace {

using namespace shapes;

/// Sliding, sticking, losing: whatever the law does, both sides get the same.
void check_balance(const std::string& name, Experiment experiment) {
  experiment.law = {.restitution = 0.7, .friction = 0.7, .lever_is_radius = false};
  experiment.contact_times = 12.0;  // in a fold it touches more than once
  const Result result = carry_out(experiment);
  double linear = 0.0;
  double angular = 0.0;
  double spin = 0.0;
  for (const Outcome& copy : result.copies) {
    EXPECT_EQ(norm(copy.force.back()), 0.0) << "still in contact";
    const double momentum = result.mass * std::max(norm(copy.before.velocity), norm(copy.after.velocity));
    const Vec2 change = result.mass * (copy.after.velocity - copy.before.velocity);
    const double turned = angular_momentum(result, copy.after) - angular_momentum(result, copy.before);
    linear = std::max(linear, norm(change + copy.impulse) / momentum);
    angular = std::max(angular, std::abs(turned + copy.moment) / (momentum * radius));
    spin = std::max(spin, radius * std::abs(copy.after.spin) / norm(copy.after.velocity));
  }
  EXPECT_GT(spin, 0.05) << "friction did nothing";
  const std::string full = "momentum and moment passed on: " + name;
  verification::check(
      row(full, "largest momentum missing, over the particle's", 0.0, linear, 1e-12, "exact: round-off"));
  verification::check(row(full, "largest moment missing, over the particle's momentum times R", 0.0, angular, 1e-9,
                          "exact: round-off of places a few metres from the origin, 1e-16 of them 4000 radii"));
}

TEST(ContactBalance, MomentumAndMomentArePassedOn) {
  check_balance("joint", across(0.0));
  check_balance("convex corner of 90 degrees", across(-90.0));
  check_balance("fold of 45 degrees", across(45.0));
  check_balance("turning and stretching segment", on_turning_segment());
  check_balance("over the chord, joint", over_chord(across(0.0, 200)));
  check_balance("over the chord, convex corner of 90 degrees", over_chord(across(-90.0, 200)));
  check_balance("over the chord, fold of 45 degrees", over_chord(across(45.0, 200)));
  check_balance("over the chord, turning and stretching segment", over_chord(on_turning_segment()));
}

/// Segments a twentieth of D long instead of ten D: the same surface, so the same forces.
void check_division(const std::string& name, Experiment (*contact)(Experiment), double round_off) {
  for (const double degrees : {0.0, -45.0, 45.0}) {
    const Result whole = carry_out(contact(across(degrees)));
    const Result divided = carry_out(contact(across(degrees, 200)));
    double worst = 0.0;
    double largest = 0.0;
    for (std::size_t k = 0; k < whole.copies.size(); ++k) {
      for (std::size_t n = 0; n < whole.copies[k].force.size(); ++n) {
        worst = std::max(worst, norm(whole.copies[k].force[n] - divided.copies[k].force[n]));
        largest = std::max(largest, norm(whole.copies[k].force[n]));
      }
    }
    verification::check(row("particles much smaller and much larger than a segment" + name,
                            "largest difference of the force, legs of 1 and of 200 segments, bend of " +
                                std::to_string(static_cast<int>(degrees)) + " degrees",
                            0.0, worst / largest, round_off, "exact: round-off of the nodes' places"));
  }
}

TEST(ContactBalance, SizeOfTheSegmentsIsNotFelt) {
  check_division(
      "", [](Experiment experiment) { return experiment; }, 1e-9);
}

// The overlap's measure goes with its depth to the power 5/2: places 1e-13 of it off are felt more in first touches.
TEST(ContactBalance, SizeOfTheSegmentsIsNotFeltOverTheChord) { check_division(", over the chord", over_chord, 1e-6); }

constexpr double hill = 2e-3;  // m, radius

/// Moments about the centre of a hill of so many segments, over impulse and hill's radius.
std::vector<double> moments_on_hill(int segments) {
  constexpr int places = 160;
  // The middle of a long segment lies below the round hill: some touch late.
  Experiment experiment{.nodes = {}, .particles = {}, .contact_times = 25.0};
  const double opening = 2.0 * std::numbers::pi / 3.0;
  for (int i = 0; i <= segments; ++i) {
    const double angle = std::numbers::pi / 2.0 + opening * (0.5 - static_cast<double>(i) / segments);
    experiment.nodes.push_back({{hill * std::cos(angle), hill * std::sin(angle)}});
  }
  for (int k = 0; k < places; ++k) {
    const double x = 1.2e-3 * (2.0 * spread(k) - 1.0);
    const double y = std::sqrt(std::pow(hill + radius, 2) - x * x) + 2e-7;
    experiment.particles.push_back({{{x, y}}, {{0.0, -1.0}}, 0.0});
  }
  const Result result = carry_out(experiment);
  std::vector<double> moments;
  for (const Outcome& copy : result.copies) {
    EXPECT_GT(norm(copy.impulse), 0.0);
    const double change = angular_momentum(result, copy.after) - angular_momentum(result, copy.before);
    moments.push_back(change / (norm(copy.impulse) * hill));
  }
  return moments;
}

// On a frictionless round hill the force points away from its centre and keeps the particle's angular momentum about
// it. The normal of a segment of length h misses the centre by up to h/2; over a node it does not. A short touch meets
// a segment with the probability hill/(hill + R), anywhere on it: root mean square h sqrt(hill/(hill + R)/12).
TEST(ContactBalance, PolygonOfManySegmentsIsRound) {
  const std::string name = "a polygon instead of a round hill";
  std::vector<double> lengths;
  std::vector<double> errors;
  std::vector<double> expected;
  double most = 0.0;
  for (const int segments : {8, 16, 32, 64}) {
    const double length = 2.0 * std::sin(std::numbers::pi / 3.0 / segments);  // over the hill's radius
    double sum = 0.0;
    const std::vector<double> moments = moments_on_hill(segments);
    for (const double moment : moments) {
      most = std::max(most, std::abs(moment) / (0.5 * length));
      sum += moment * moment / static_cast<double>(moments.size());
    }
    lengths.push_back(length);
    errors.push_back(std::sqrt(sum));
    expected.push_back(length / std::sqrt(12.0));
    verification::Comparison c = row(name,
                                     "moment (root mean square) over impulse and radius, segments of " +
                                         std::to_string(length * hill / (2.0 * radius)).substr(0, 4) + " D",
                                     expected.back(), errors.back(), 0.1, "statistics: 160 places");
    c.reference = "closed form h/sqrt(12)";
    c.origin = "normals of a polygon with segments of length h";
    verification::check(c);
  }
  verification::check(row(name, "largest moment about the centre, over impulse times half a segment", 0.0, most,
                          1.0 + 1e-9, "exact: a bound, no normal misses the centre by more"));
  verification::curve({.group = "contact",
                       .name = name,
                       .title = name,
                       .x_label = "segment / radius of the hill",
                       .y_label = "moment / (impulse x radius of the hill)",
                       .axes = verification::Curve::Axes::log_log,
                       .series = {{"found", lengths, errors, {}},
                                  {"closed form", lengths, expected, verification::Series::Mark::line}}});
}

}  // namespace
}  // namespace grainstep::dem
