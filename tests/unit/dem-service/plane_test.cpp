// A particle at the mirror plane is one half of a head-on collision with its image: closed forms of that pair.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem-service/law/damping.hpp"
#include "dem-service/law/plane_contacts.hpp"

namespace grainstep::dem {
namespace {

constexpr double radius = 0.5e-3;
constexpr double mass = 2e-6;
constexpr double stiffness = 7.3e6;
constexpr double speed = 10.0;

struct Bounce {
  double departure = 0.0;       ///< m/s
  double largest_way = 0.0;     ///< m, of the particle beyond first touch
  double duration = 0.0;        ///< s
  double stored_at_most = 0.0;  ///< J
  double damping = 0.0;         ///< J
};

/// Velocity Verlet whose forces see the velocity half a step earlier, as LAMMPS moves particles.
Bounce bounce(double restitution, double dt) {
  const Collision pair{stiffness, mass / 2.0, restitution, false};
  ContactLaw law;
  law.normal_stiffness = stiffness;
  law.damping_rate = continuum_damping(pair);
  PlaneContacts mirror({.kind = Plane::Kind::mirror}, law, radius);
  double x[3] = {radius, 0.0, 0.0};
  double v[3] = {-speed, 0.0, 0.0};
  double f[3] = {};
  double* position[] = {x};
  double* velocity[] = {v};
  double* force[] = {f};
  const ParticleArrays particles{
      .owned = 1, .position = position, .velocity = velocity, .force = force, .radius = &radius, .mass = &mass};
  mirror.rebuild(particles);
  Bounce result;
  constexpr int far_too_many = 100'000;  // a contact has a few thousand
  for (int step = 0; (step == 0 || x[0] < radius) && step < far_too_many; ++step) {
    mirror.begin_interval(dt);
    v[0] += 0.5 * dt * f[0] / mass;
    x[0] += dt * v[0];
    f[0] = 0.0;
    mirror.evaluate(particles);
    mirror.apply(particles);
    v[0] += 0.5 * dt * f[0] / mass;
    mirror.end_interval(particles, dt);
    result.largest_way = std::max(result.largest_way, radius - x[0]);
    result.stored_at_most = std::max(result.stored_at_most, mirror.stored());
    result.duration += dt;
  }
  result.departure = v[0];
  result.damping = mirror.ledger().damping;
  return result;
}

// The pair's overlap obeys (m/2) delta'' = -Kn delta with delta'(0) = 2 v: its half is the particle's way, and half of
// its energy, m v^2/2, is the particle's.
TEST(Mirror, IsAnElasticPairOfEqualParticles) {
  const double rate = std::sqrt(stiffness / (mass / 2.0));
  const Bounce b = bounce(1.0, 1e-3 / rate);
  constexpr double of_the_step = 2e-3;  // a thousandth of the phase at each end of the contact
  EXPECT_NEAR(b.largest_way * rate / speed, 1.0, of_the_step);
  EXPECT_NEAR(b.duration * rate / std::numbers::pi, 1.0, of_the_step);
  EXPECT_NEAR(b.stored_at_most / (0.5 * mass * speed * speed), 1.0, of_the_step);
  EXPECT_NEAR(b.departure / speed, 1.0, of_the_step);
  EXPECT_EQ(b.damping, 0.0);
}

TEST(Mirror, ReturnsThePairsRestitutionInThePairsContactTime) {
  const Collision pair{stiffness, mass / 2.0, 0.7, false};
  const double time = contact_time(pair);
  const Bounce b = bounce(0.7, 1e-3 * time);
  constexpr double of_the_step = 4e-3;  // three thousandths of the phase per step
  EXPECT_NEAR(b.departure / speed, 0.7, of_the_step);
  EXPECT_NEAR(b.duration / time, 1.0, of_the_step);
  EXPECT_NEAR(b.damping / (0.5 * mass * speed * speed), 1.0 - 0.49, 2.0 * of_the_step);
}

}  // namespace
}  // namespace grainstep::dem
