/// @file The shapes of the contact cases: bends that particles slide across, and a segment that turns and stretches.
#pragma once

#include <numbers>

#include "shapes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem::shapes {

inline constexpr int copy_count = 60;

/// Two legs of 10 mm that meet at the origin; degrees > 0 fold up, < 0 fall away (a convex corner). Each leg is one
/// segment or is divided.
inline std::vector<Vec2> bend(double degrees, int segments_per_leg = 1) {
  const double half = degrees / 2.0 * std::numbers::pi / 180.0;
  std::vector<Vec2> nodes;
  for (int i = -segments_per_leg; i <= segments_per_leg; ++i) {
    const double along = 0.01 * i / segments_per_leg;
    nodes.push_back({{along * std::cos(half), std::abs(along) * std::sin(half)}});
  }
  return nodes;
}

/// Fractions that fill (0, 1) evenly, in no order that a step could share.
inline double spread(int k) {
  const double x = 0.5 + 0.6180339887498949 * k;
  return x - std::floor(x);
}

/// Particles at 100 m/s along the left leg and 20 m/s against it, which touch it over the last quarter of a millimetre
/// before the bend (or before the place where a fold touches both legs), and slide across.
inline Experiment across(double degrees, int segments_per_leg = 1) {
  Experiment experiment{.nodes = bend(degrees, segments_per_leg), .particles = {}};
  const double half = degrees / 2.0 * std::numbers::pi / 180.0;
  const Vec2 tangent{{std::cos(half), -std::sin(half)}};
  const Vec2 normal{{std::sin(half), std::cos(half)}};
  const Vec2 velocity = 100.0 * tangent - 20.0 * normal;
  constexpr double coarsest_step = 1.2e-7;  // s
  for (int k = 0; k < copy_count; ++k) {
    double along = -0.25e-3 * (k + 0.5) / copy_count;
    if (degrees > 0.0) along -= radius * std::tan(half);
    const double early = coarsest_step * spread(k);
    experiment.particles.push_back({along * tangent + radius * normal - early * velocity, velocity, 0.0});
  }
  return experiment;
}

/// A segment of 20 mm in two, which turns ever faster about one end and is stretched at the same time: by 20 000 to
/// 24 000 rad/s and 30 000/s, i.e. 0.1 rad and 15% in the time of the experiment.
inline Experiment on_turning_segment() {
  Experiment experiment{.nodes = {{{0, 0}}, {{0.01, 0}}, {{0.02, 0}}}, .particles = {}};
  experiment.path = [](double t, const Vec2& x) {
    const double angle = 2e4 * t + 2e8 * t * t;
    const double length = (1.0 + 3e4 * t) * x[0];
    return Vec2{{length * std::cos(angle), length * std::sin(angle)}};
  };
  for (int k = 0; k < copy_count; ++k) {
    experiment.particles.push_back({{{9.8e-3 + 6e-6 * k, radius + 5e-5 * spread(k) + 1e-6}}, {{30.0, -40.0}}, 0.0});
  }
  return experiment;
}

inline verification::Comparison row(const std::string& name, const std::string& quantity, double expected, double found,
                                    double tolerance, const std::string& reason) {
  return {.group = "contact",
          .name = name,
          .quantity = quantity,
          .unit = "",
          .reference = "continuity and balance",
          .origin = "docs/theory/contact.md",
          .expected = expected,
          .found = found,
          .tolerance = tolerance,
          .reason = reason};
}

}  // namespace grainstep::dem::shapes
