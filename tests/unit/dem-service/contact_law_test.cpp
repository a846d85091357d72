#include "dem-service/contact_law.hpp"

#include <gtest/gtest.h>

namespace grainstep::dem {
namespace {

constexpr ContactLaw law{.normal_stiffness = 100.0,
                         .tangential_stiffness = 40.0,
                         .damping_rate = 3.0,
                         .friction = 0.5,
                         .tension_cutoff = false};

TEST(ContactLaw, SpringPushesAndDashpotResistsApproach) {
  const NormalForce force = normal_force(law, 0.02, 0.5, 2.0);
  EXPECT_DOUBLE_EQ(force.spring, 2.0);
  EXPECT_DOUBLE_EQ(force.dashpot, 3.0);
  EXPECT_DOUBLE_EQ(force.total(), 5.0);
}

TEST(ContactLaw, PullsOnDepartureUnlessCutOff) {
  EXPECT_DOUBLE_EQ(normal_force(law, 0.02, -0.5, 2.0).total(), -1.0);
  ContactLaw cut = law;
  cut.tension_cutoff = true;
  EXPECT_DOUBLE_EQ(normal_force(cut, 0.02, -0.5, 2.0).total(), 0.0);
  EXPECT_DOUBLE_EQ(normal_force(cut, 0.02, -0.5, 2.0).spring, 2.0);
  EXPECT_DOUBLE_EQ(normal_force(cut, 0.02, -0.1, 2.0).total(), 1.4);
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
  const Vec3 turned = turned_into_tangent_plane(spring, normal);
  EXPECT_NEAR(dot(turned, normal) / 0.05, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(norm(turned), 0.05);
  EXPECT_GT(dot(turned, spring), 0.0);
  EXPECT_EQ(turned_into_tangent_plane(spring, {{1.0, 0.0, 0.0}}), Vec3{});
  EXPECT_EQ(turned_into_tangent_plane(Vec3{}, normal), Vec3{});
}

}  // namespace
}  // namespace grainstep::dem
