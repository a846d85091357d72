#include "contact/contact_law.hpp"

#include <gtest/gtest.h>

namespace grainstep::contact {
namespace {

const ContactLaw law{.normal_stiffness = 100.0,
                     .tangential_stiffness = 40.0,
                     .damping_rate = 3.0,
                     .friction = 0.5,
                     .tension_cutoff = false};

const Branch upwards = branch_along({{0.0, 1.0, 0.0}}, 0.25, 0.27);

/// N, of a particle of 2 kg that comes nearer with `approach` (m/s).
NormalForce force_on(const ContactLaw& of, double approach, const Branch& branch = upwards) {
  NormalForce force = normal_force(of, branch, 0.02, branch.vector * (-approach * branch.per_length), 2.0);
  force.spring *= branch.length;
  force.dashpot *= branch.length;
  return force;
}

TEST(ContactLaw, SpringPushesAndDashpotResistsApproach) {
  const NormalForce force = force_on(law, 0.5);
  EXPECT_DOUBLE_EQ(force.spring, 2.0);
  EXPECT_DOUBLE_EQ(force.dashpot, 3.0);
  EXPECT_DOUBLE_EQ(force.total(), 5.0);
}

TEST(ContactLaw, ForceDependsOnlyOnOverlapAlsoWithTheCentreInside) {
  for (const double length : {-0.25, -1e-14, 0.0, 1e-14}) {
    const Branch branch = branch_along({{0.6, 0.8, 0.0}}, length, 0.27);
    EXPECT_NEAR(norm(branch.vector * branch.per_length - Vec3{{0.6, 0.8, 0.0}}), 0.0, 1e-15) << length;
    EXPECT_DOUBLE_EQ(force_on(law, 0.5, branch).total(), 5.0) << length;
  }
}

TEST(ContactLaw, PullsOnDepartureUnlessCutOff) {
  EXPECT_DOUBLE_EQ(force_on(law, -0.5).total(), -1.0);
  ContactLaw cut = law;
  cut.tension_cutoff = true;
  for (const double length : {0.25, -0.25}) {
    const Branch branch = branch_along({{0.0, 1.0, 0.0}}, length, 0.27);
    EXPECT_DOUBLE_EQ(force_on(cut, -0.5, branch).total(), 0.0);
    EXPECT_DOUBLE_EQ(force_on(cut, -0.5, branch).spring, 2.0);
    EXPECT_DOUBLE_EQ(force_on(cut, -0.1, branch).total(), 1.4);
  }
}

TEST(ContactLaw, SlipIsTheSkinsVelocityInTheTangentPlane) {
  const Vec3 spin{{0.0, 0.0, 2.0}};  // the lowest point moves towards +x1
  const Vec3 slip = slip_rate(upwards, {{3.0, -7.0, 0.0}}, 0.27, spin);
  EXPECT_DOUBLE_EQ(slip[0], 3.0 + 2.0 * 0.27);
  EXPECT_NEAR(slip[1], 0.0, 1e-15 * 7.0);
}

TEST(ContactLaw, SticksBelowTheCoulombLimit) {
  Vec3 spring{{0.01, 0.0, 0.0}};
  const Vec3 force = tangential_force(law, 1.0, spring);
  EXPECT_DOUBLE_EQ(force[0], -0.4);
  EXPECT_DOUBLE_EQ(spring[0], 0.01);
}

TEST(ContactLaw, SlidesAtTheCoulombLimitWithATruncatedSpring) {
  Vec3 spring{{0.03, 0.04, 0.0}};  // trial force 2 N
  const Vec3 force = tangential_force(law, -1.0, spring);
  EXPECT_DOUBLE_EQ(norm(force), 0.5);  // the limit takes the normal force's size, also while it pulls
  EXPECT_DOUBLE_EQ(norm(spring), 0.5 / 40.0);
  EXPECT_DOUBLE_EQ(spring[1] / spring[0], 4.0 / 3.0);
  EXPECT_DOUBLE_EQ(dot(force, spring), -norm(force) * norm(spring));
}

TEST(ContactLaw, NoNormalForceNoFriction) {
  Vec3 spring{{0.03, 0.0, 0.0}};
  EXPECT_EQ(tangential_force(law, 0.0, spring), Vec3{});
  EXPECT_EQ(spring, Vec3{});
}

TEST(ContactLaw, SpringTurnsWithTheSurfaceAndKeepsItsLength) {
  const Vec3 spring{{0.05, 0.0, 0.0}};
  const Vec3 normal{{std::sin(0.3), std::cos(0.3), 0.0}};
  const Vec3 turned = turned_into_tangent_plane(spring, normal, 1e-15);
  EXPECT_NEAR(dot(turned, normal) / 0.05, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(norm(turned), 0.05);
  EXPECT_GT(dot(turned, spring), 0.0);
  EXPECT_EQ(turned_into_tangent_plane(spring, {{1.0, 0.0, 0.0}}, 1e-15), Vec3{});
  EXPECT_EQ(turned_into_tangent_plane(Vec3{}, normal, 0.0), Vec3{});
  const Vec3 nearly_flat{{0.05, 1e-18, 0.0}};
  EXPECT_EQ(turned_into_tangent_plane(nearly_flat, {{0.0, 1.0, 0.0}}, 1e-15), nearly_flat);
}

}  // namespace
}  // namespace grainstep::contact
