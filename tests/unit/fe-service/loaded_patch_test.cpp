/// @file Which segments a pressure finds, and what their nodes get: resultant and moment in closed form.
#include "fe-service/load/loaded_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace grainstep::fe {
namespace {

constexpr double round_off = 1e-14;

/// A loaded face from 0 to 1 in uneven segments, and an end face down from it that no pressure on the face reaches.
wire::Surface face() {
  wire::Surface surface;
  for (const double x : {0.0, 0.1, 0.25, 0.6, 1.0}) {
    surface.add_position(x);
    surface.add_position(0.0);
  }
  surface.add_position(1.0);
  surface.add_position(-0.2);
  for (std::uint32_t k = 0; k < 5; ++k) {
    surface.add_facet(k);
    surface.add_facet(k + 1);
  }
  return surface;
}

scene::Pressure patch(double from, double to) {
  scene::Pressure pressure;
  pressure.mutable_patch()->set_from(from);
  pressure.mutable_patch()->set_to(to);
  return pressure;
}

std::vector<double> positions(const wire::Surface& surface) {
  std::vector<double> out;
  for (const double value : surface.position()) out.push_back(value);
  return out;
}

struct Resultant {
  double x = 0.0, y = 0.0, moment = 0.0;  ///< about the origin
};

Resultant resultant(const std::vector<double>& position, const std::vector<double>& nodal) {
  Resultant sum;
  for (std::size_t i = 0; i < nodal.size(); i += 2) {
    sum.x += nodal[i];
    sum.y += nodal[i + 1];
    sum.moment += position[i] * nodal[i + 1] - position[i + 1] * nodal[i];
  }
  return sum;
}

Resultant pressed(const LoadedPatch& loaded, const std::vector<double>& position) {
  std::vector<double> nodal(position.size(), 0.0);
  loaded.press(3.0, PlaneStrain{0.5}, position, nodal);
  return resultant(position, nodal);
}

TEST(LoadedPatch, TakesTheLoadedFaceAndNothingElse) {
  const LoadedPatch loaded(face(), {});
  EXPECT_DOUBLE_EQ(loaded.width(), 1.0);
  const Resultant sum = pressed(loaded, positions(face()));
  EXPECT_NEAR(sum.y, -3.0 * 0.5, round_off);
  EXPECT_EQ(sum.x, 0.0);
  EXPECT_NEAR(sum.moment, -3.0 * 0.5 * 0.5, round_off);
}

// The patch begins and ends within segments, once within one and the same: force and moment are those of the patch.
TEST(LoadedPatch, SharesOfPartlyCoveredSegmentsHaveForceAndMomentOfThePatch) {
  for (const auto& [from, to] : {std::pair{0.05, 0.7}, {0.3, 0.5}, {-1.0, 0.12}, {0.9, 2.0}, {0.1, 0.25}}) {
    const double left = std::max(from, 0.0);
    const double right = std::min(to, 1.0);
    const Resultant sum = pressed(LoadedPatch(face(), patch(from, to)), positions(face()));
    EXPECT_NEAR(sum.y, -1.5 * (right - left), round_off) << from;
    EXPECT_NEAR(sum.moment, -1.5 * 0.5 * (right * right - left * left), round_off) << from;
  }
}

// Turned by an angle and stretched twofold: twice the force, along the turned normal, about the turned middle.
TEST(LoadedPatch, FollowsTheSurface) {
  const double angle = 0.7;
  std::vector<double> moved = positions(face());
  for (std::size_t i = 0; i < moved.size(); i += 2) {
    const double x = 2.0 * moved[i];
    const double y = 2.0 * moved[i + 1];
    moved[i] = std::cos(angle) * x - std::sin(angle) * y;
    moved[i + 1] = std::sin(angle) * x + std::cos(angle) * y;
  }
  const Resultant sum = pressed(LoadedPatch(face(), patch(0.05, 0.7)), moved);
  const double force = 1.5 * 2.0 * 0.65;
  EXPECT_NEAR(sum.x, force * std::sin(angle), 10 * round_off);
  EXPECT_NEAR(sum.y, -force * std::cos(angle), 10 * round_off);
  EXPECT_NEAR(sum.moment, -force * (0.05 + 0.7), 10 * round_off);
}

/// Area of the polygon from the nodes of the face to where they are after a time, and back.
double swept(const std::vector<double>& position, const std::vector<double>& velocity, double time) {
  std::vector<Vec2> ring;
  for (std::size_t i = 0; i < 10; i += 2) ring.push_back({position[i], position[i + 1]});
  for (std::size_t i = 10; i > 0; i -= 2) {
    ring.push_back({position[i - 2] + time * velocity[i - 2], position[i - 1] + time * velocity[i - 1]});
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += 0.5 * cross(ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

// The work of a pressure is the pressure times the area that the surface sweeps.
TEST(LoadedPatch, WorkIsPressureTimesSweptArea) {
  std::vector<double> bent = positions(face());
  std::vector<double> velocity(bent.size());
  for (std::size_t i = 0; i < bent.size(); i += 2) {
    bent[i + 1] += 0.3 * std::sin(2.0 * bent[i]);
    velocity[i] = 0.1 * bent[i];
    velocity[i + 1] = 1.0 - bent[i] * bent[i];
  }
  std::vector<double> nodal(bent.size(), 0.0);
  LoadedPatch(face(), {}).press(1.0, PlaneStrain{1.0}, bent, nodal);
  const double power = std::inner_product(nodal.begin(), nodal.end(), velocity.begin(), 0.0);
  constexpr double dt = 1e-3;  // the area is quadratic in time: its central difference is exact
  EXPECT_NEAR(power, -(swept(bent, velocity, dt) - swept(bent, velocity, -dt)) / (2.0 * dt), 1e-12);
}

TEST(LoadedPatch, RefusesAPatchBesideTheFace) { EXPECT_THROW(LoadedPatch(face(), patch(2.0, 3.0)), InputError); }

// Of revolution: force p pi R^2, and the work on any motion is p times the volume that the surface sweeps.
TEST(LoadedPatch, PressesRings) {
  const std::vector<double> position = positions(face());
  for (const auto& [from, to] : {std::pair{0.0, 1.0}, std::pair{0.05, 0.4}, std::pair{0.7, 0.8}}) {
    std::vector<double> nodal(position.size(), 0.0);
    LoadedPatch(face(), patch(from, to)).press(3.0, Axisymmetric{}, position, nodal);
    EXPECT_NEAR(resultant(position, nodal).y, -3.0 * M_PI * (to * to - from * from), 1e-13);
    // Pushed in by a cone w = r: the integral of r 2 pi r.
    double work = 0.0;
    for (std::size_t i = 0; i < nodal.size(); i += 2) work -= nodal[i + 1] * position[i];
    EXPECT_NEAR(work, 3.0 * 2.0 * M_PI * (to * to * to - from * from * from) / 3.0, 1e-13);
  }
}

TEST(LoadedPatch, PressesACone) {
  std::vector<double> position = positions(face());
  for (std::size_t i = 0; i < 10; i += 2) position[i + 1] = -0.5 * position[i];
  std::vector<double> nodal(position.size(), 0.0);
  LoadedPatch(face(), {}).press(3.0, Axisymmetric{}, position, nodal);
  // Along z it feels its shadow, along r slope times that (2 pi r dr): outwards normal (0.5, 1), pressed against it.
  EXPECT_NEAR(resultant(position, nodal).y, -3.0 * M_PI, 1e-13);
  EXPECT_NEAR(resultant(position, nodal).x, -3.0 * M_PI * 0.5, 1e-13);
}

}  // namespace
}  // namespace grainstep::fe
