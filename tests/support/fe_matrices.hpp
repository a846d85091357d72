/// @file Stiffness of a quad as a matrix, and of a whole body, written out plainly.
#pragma once

#include <Eigen/Dense>

#include "fe-service/body.hpp"

namespace grainstep::fe::test {

/// Unit thickness; degrees of freedom 2 x node + component, nodes: the four corners from the lower left
/// counter-clockwise, then the centre.
inline Eigen::Matrix<double, 10, 10> quad_stiffness(const Body& body, int row, int column) {
  const Elastic& law = elastic_part(body.material(row));
  Eigen::Matrix3d elasticity;
  const double modulus = law.lambda + 2.0 * law.mu;
  elasticity << modulus, law.lambda, 0.0, law.lambda, modulus, 0.0, 0.0, 0.0, law.mu;
  Eigen::Matrix<double, 10, 10> stiffness = Eigen::Matrix<double, 10, 10>::Zero();
  for (int t = 0; t < kQuadTriangles; ++t) {
    const auto nodes = body.triangle(row, column, t);
    Eigen::Matrix3d shape;
    shape << 1.0, nodes.a.x, nodes.a.y, 1.0, nodes.b.x, nodes.b.y, 1.0, nodes.centre.x, nodes.centre.y;
    const Eigen::Matrix<double, 2, 3> grad = shape.inverse().bottomRows<2>();
    Eigen::Matrix<double, 3, 10> strain = Eigen::Matrix<double, 3, 10>::Zero();
    const int node[] = {t, (t + 1) % 4, 4};
    for (int n = 0; n < 3; ++n) {
      strain(0, 2 * node[n]) = strain(2, 2 * node[n] + 1) = grad(0, n);
      strain(1, 2 * node[n] + 1) = strain(2, 2 * node[n]) = grad(1, n);
    }
    stiffness += nodes.area() * strain.transpose() * elasticity * strain;
  }
  return stiffness;
}

/// Largest omega^2 of K w = omega^2 M w with a diagonal M.
inline double largest_frequency(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& mass) {
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = root.asDiagonal() * stiffness * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// Of a quad alone, with its own share of the mass.
inline double quad_frequency(const Body& body, int row, int column) {
  const double mass = elastic_part(body.material(row)).density * body.mesh().rows[row].quad_area;
  Eigen::VectorXd masses = Eigen::VectorXd::Constant(10, mass / 6.0);
  masses.tail<2>().setConstant(mass / 3.0);
  return largest_frequency(quad_stiffness(body, row, column), masses);
}

/// Of the whole body without supports.
inline double body_frequency(const Body& body) {
  const Mesh& mesh = body.mesh();
  const int per_row = mesh.columns + 1;
  const int corners = per_row * (mesh.row_count() + 1);
  const int nodes = corners + mesh.columns * mesh.row_count();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(2 * nodes);
  for (int row = 0; row < mesh.row_count(); ++row) {
    for (int column = 0; column < mesh.columns; ++column) {
      const auto quad = quad_stiffness(body, row, column);
      const double mass = elastic_part(body.material(row)).density * mesh.rows[row].quad_area;
      const int at[] = {(row + 1) * per_row + column, (row + 1) * per_row + column + 1, row * per_row + column + 1,
                        row * per_row + column, corners + row * mesh.columns + column};
      for (int i = 0; i < 10; ++i) {
        masses[2 * at[i / 2] + i % 2] += i < 8 ? mass / 6.0 : mass / 3.0;
        for (int j = 0; j < 10; ++j) stiffness(2 * at[i / 2] + i % 2, 2 * at[j / 2] + j % 2) += quad(i, j);
      }
    }
  }
  return largest_frequency(stiffness, masses);
}

}  // namespace grainstep::fe::test
