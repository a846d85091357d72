// Sleepers of the native engine: who may sleep, and that nobody is woken too late.
#include "dem-service/native/flight.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace grainstep::dem::native {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

SlugModel model() {
  SlugModel out;
  out.diameter = 1e-3;
  return out;
}

PlacedParticle at(double x, double y, const surface::Vec3& velocity) { return {{{x, y, 0.0}}, velocity, 0.0, 0.0}; }

const surface::Vec3 down{{0.0, -400.0, 0.0}};

std::vector<PlacedParticle> column() { return {at(0.0, 9e-3, down), at(0.0, 1e-3, down), at(0.0, 5e-3, down)}; }

TEST(NativeFlight, TheHeadIsFirst) {
  std::vector<PlacedParticle> particles = column();
  const Flight flight(model(), particles);
  EXPECT_EQ(flight.awake(), 0);
  EXPECT_EQ(particles[0].position[1], 1e-3);
  EXPECT_EQ(particles[2].position[1], 9e-3);
  EXPECT_EQ(flight.identities(), (std::vector<std::int32_t>{2, 3, 1}));
}

TEST(NativeFlight, WhoComesNearTheSurfaceWakes) {
  std::vector<PlacedParticle> particles = column();
  Flight flight(model(), particles);
  EXPECT_FALSE(flight.near(nothing, 0.0, 0.0, 0.4e-3));  // the first one's lowest point is at 0.5 mm
  EXPECT_TRUE(flight.near(nothing, 0.0, 0.0, 0.6e-3));
  EXPECT_EQ(flight.wake(nothing, 0.0, 0.0, 0.6e-3), 1);
  EXPECT_EQ(flight.wake(nothing, 0.0, 4e-3 / 400.0, 0.6e-3), 2);  // 4 mm later
  EXPECT_EQ(flight.wake(nothing, 20e-3, 0.0, 0.0), 3);
  EXPECT_TRUE(flight.all_awake());
}

TEST(NativeFlight, WhoIsMetFromBelowWakes) {
  std::vector<PlacedParticle> particles = column();
  Flight flight(model(), particles);
  const double time = 1e-6;
  const double still[3] = {0.0, 4.0e-3, 0.0};  // stands there: as seen by who flies along it is at 4.4 mm
  const double front = flight.behind(still, time);
  EXPECT_NEAR(front, 4.4e-3, 1e-15);
  EXPECT_EQ(flight.wake(front, nothing, time, 0.2e-3), 2);  // the second one's leading point is at 4.5 mm
}

TEST(NativeFlight, ALargeOneFarBehindReachesAheadOfASmallOne) {
  std::vector<PlacedParticle> particles = {at(0.0, 1e-3, down), at(1e-3, 2e-3, down)};
  particles[0].diameter = 0.2e-3;
  particles[1].diameter = 2.4e-3;
  Flight flight(model(), particles);
  EXPECT_EQ(flight.wake(nothing, 0.0, 0.0, 0.85e-3), 2);
}

TEST(NativeFlight, NobodySleepsWhoMightMeetAnother) {
  std::vector<PlacedParticle> faster = column();
  faster[0].velocity = {{0.0, -401.0, 0.0}};
  EXPECT_TRUE(Flight(model(), faster).all_awake());
  std::vector<PlacedParticle> turning = column();
  turning[1].spin = 1.0;
  EXPECT_TRUE(Flight(model(), turning).all_awake());
  std::vector<PlacedParticle> resting = {at(0.0, 1e-3, {})};
  EXPECT_TRUE(Flight(model(), resting).all_awake());
}

TEST(NativeFlight, NobodySleepsWhoFliesTowardsAPlane) {
  const surface::Vec3 aside{{100.0, -400.0, 0.0}};
  SlugModel open = model();
  SlugModel confined = model();
  confined.confined = true;
  std::vector<PlacedParticle> particles = {at(0.0, 1e-3, aside)};
  EXPECT_FALSE(Flight(open, particles).all_awake());
  EXPECT_TRUE(Flight(confined, particles).all_awake());
  particles = {at(0.0, 1e-3, down)};
  EXPECT_FALSE(Flight(confined, particles).all_awake());
}

}  // namespace
}  // namespace grainstep::dem::native
