#include "fe-service/triangle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace grainstep::fe {
namespace {

constexpr double kRoundOff = 1e-14;

Vec2 turned(Vec2 a, double angle) {
  return {std::cos(angle) * a.x - std::sin(angle) * a.y, std::sin(angle) * a.x + std::cos(angle) * a.y};
}

TEST(Triangle, FiniteRotationGivesNoStrainAndItsExactAngle) {
  const Vec2 a{0.3, -0.2};
  const Vec2 b{0.25, 0.4};
  for (const double angle : {1e-6, 0.1, 1.0, 2.5, -1.3}) {
    const Vec2 moved_a = turned(a, angle) - a;
    const Vec2 moved_b = turned(b, angle) - b;
    const TriangleMotion m = motion(a + 0.5 * moved_a, b + 0.5 * moved_b, moved_a, moved_b);
    EXPECT_NEAR(m.xx, 0.0, kRoundOff);
    EXPECT_NEAR(m.yy, 0.0, kRoundOff);
    EXPECT_NEAR(m.gamma, 0.0, kRoundOff);
    EXPECT_NEAR(m.half_tangent, std::tan(0.5 * angle), kRoundOff);
  }
}

TEST(Triangle, LinearDisplacementIsReproduced) {
  const Vec2 a{0.3, -0.2};
  const Vec2 b{0.25, 0.4};
  const auto field = [](Vec2 p) { return Vec2{1e-3 * p.x + 2e-3 * p.y, -4e-3 * p.x + 5e-3 * p.y}; };
  const TriangleMotion m = motion(a, b, field(a), field(b));
  EXPECT_NEAR(m.xx, 1e-3, kRoundOff);
  EXPECT_NEAR(m.yy, 5e-3, kRoundOff);
  EXPECT_NEAR(m.gamma, -2e-3, kRoundOff);
  EXPECT_NEAR(m.half_tangent, 0.5 * 0.5 * (-4e-3 - 2e-3), kRoundOff);
}

TEST(Triangle, StressTurnsByTheAngle) {
  const Stress stress{3.0, -1.0, 0.7, 2.0};
  Eigen::Matrix2d matrix;
  matrix << stress.xx, stress.xy, stress.xy, stress.yy;
  for (const double angle : {0.01, 0.5, 3.0, -2.0}) {
    const Eigen::Matrix2d expected =
        Eigen::Rotation2Dd(angle).toRotationMatrix() * matrix * Eigen::Rotation2Dd(-angle).toRotationMatrix();
    const Stress found = rotate(stress, std::tan(0.5 * angle));
    EXPECT_NEAR(found.xx, expected(0, 0), kRoundOff);
    EXPECT_NEAR(found.yy, expected(1, 1), kRoundOff);
    EXPECT_NEAR(found.xy, expected(0, 1), kRoundOff);
    EXPECT_EQ(found.zz, stress.zz);
    const Stress twice = rotate_from_middle(rotate_from_middle(stress, std::tan(0.5 * angle)), std::tan(0.5 * angle));
    EXPECT_NEAR(twice.xx, expected(0, 0), kRoundOff);
    EXPECT_NEAR(twice.xy, expected(0, 1), kRoundOff);
  }
}

/// Stiffness matrix of a unit thickness, from strain-displacement and elasticity matrices.
Eigen::Matrix<double, 6, 6> stiffness(const Elastic& law, Vec2 a, Vec2 b) {
  const double twice_area = cross(a, b);
  const Vec2 grad_a{b.y / twice_area, -b.x / twice_area};
  const Vec2 grad_b{-a.y / twice_area, a.x / twice_area};
  const Vec2 grads[] = {grad_a, grad_b, {-grad_a.x - grad_b.x, -grad_a.y - grad_b.y}};
  Eigen::Matrix<double, 3, 6> strain = Eigen::Matrix<double, 3, 6>::Zero();
  for (int n = 0; n < 3; ++n) {
    strain(0, 2 * n) = strain(2, 2 * n + 1) = grads[n].x;
    strain(1, 2 * n + 1) = strain(2, 2 * n) = grads[n].y;
  }
  Eigen::Matrix3d elasticity;
  elasticity << law.longitudinal_modulus(), law.lambda, 0.0, law.lambda, law.longitudinal_modulus(), 0.0, 0.0, 0.0,
      law.mu;
  return 0.5 * twice_area * strain.transpose() * elasticity * strain;
}

TEST(Triangle, LargestStiffnessIsTheEigenvalue) {
  for (const double poisson : {-0.8, 0.0, 0.3, 0.49}) {
    const Elastic law = Elastic::from_young(200e9, poisson, 8000.0);
    for (const Vec2 b : {Vec2{-1.0, 1.0}, Vec2{0.2, 0.1}, Vec2{-3.0, 1.2}, Vec2{0.9, 0.02}}) {
      const Vec2 a{1.0, -0.3};
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(stiffness(law, a, b));
      const double expected = solver.eigenvalues().maxCoeff();
      EXPECT_NEAR(largest_stiffness(law, a, b), expected, 1e-12 * expected);
    }
  }
}

TEST(Triangle, TractionsAreTheGradientOfTheElasticEnergy) {
  const Elastic law = Elastic::from_young(200e9, 0.3, 8000.0);
  const Vec2 a{1.0, -0.3};
  const Vec2 b{0.2, 0.8};
  Eigen::Matrix<double, 6, 1> moved;
  moved << 1e-6, 2e-6, -3e-6, 0.5e-6, 0.0, 0.0;
  const TriangleMotion m = motion(a, b, {moved[0], moved[1]}, {moved[2], moved[3]});
  const Stress stress = law.increment({m.xx, m.yy, m.gamma, 0.0});
  const Eigen::Matrix<double, 6, 1> force = -stiffness(law, a, b) * moved;
  const double scale = force.cwiseAbs().maxCoeff();
  EXPECT_NEAR(-traction(stress, b).x, force[0], 1e-13 * scale);
  EXPECT_NEAR(-traction(stress, b).y, force[1], 1e-13 * scale);
  EXPECT_NEAR(traction(stress, a).x, force[2], 1e-13 * scale);
  EXPECT_NEAR(traction(stress, a).y, force[3], 1e-13 * scale);
}

TEST(Elastic, StoredEnergyIsHalfStressTimesStrain) {
  const Elastic law = Elastic::from_young(200e9, 0.3, 8000.0);
  const StrainIncrement e{1e-3, -2e-3, 5e-4, 3e-4};
  const Stress s = law.increment(e);
  const double expected = 0.5 * (s.xx * e.xx + s.yy * e.yy + s.zz * e.zz + s.xy * e.gamma);
  EXPECT_NEAR(law.stored_energy(s), expected, 1e-14 * expected);
}

}  // namespace
}  // namespace grainstep::fe
