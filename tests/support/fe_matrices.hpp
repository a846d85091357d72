/// @file Stiffness of a quad as a matrix, and of a whole body, written out plainly.
#pragma once

#include <Eigen/Dense>

#include "fe-service/body.hpp"

namespace grainstep::fe::test {

/// Unit thickness in plane strain, the full circle of a solid of revolution (without what a node at r = 0 cannot do,
/// and with a dilatation for each triangle: the quad's common one is softer); degrees of freedom 2 x node + component,
/// nodes: the four corners from the lower left counter-clockwise, then the centre.
inline Eigen::Matrix<double, 10, 10> quad_stiffness(const Body& body, int row, int column) {
  const Elastic& law = elastic_part(body.material(row));
  const bool rings = is_of_revolution(body.measure());
  Eigen::Matrix4d elasticity;
  const double modulus = law.lambda + 2.0 * law.mu;
  elasticity << modulus, law.lambda, 0.0, law.lambda, law.lambda, modulus, 0.0, law.lambda, 0.0, 0.0, law.mu, 0.0,
      law.lambda, law.lambda, 0.0, modulus;
  Eigen::Matrix<double, 10, 10> stiffness = Eigen::Matrix<double, 10, 10>::Zero();
  for (int t = 0; t < kQuadTriangles; ++t) {
    const auto nodes = body.triangle(row, column, t);
    Eigen::Matrix3d shape;
    shape << 1.0, nodes.a.x, nodes.a.y, 1.0, nodes.b.x, nodes.b.y, 1.0, nodes.centre.x, nodes.centre.y;
    const Eigen::Matrix<double, 2, 3> grad = shape.inverse().bottomRows<2>();
    Eigen::Matrix<double, 4, 10> strain = Eigen::Matrix<double, 4, 10>::Zero();
    const double radii = nodes.a.x + nodes.b.x + nodes.centre.x;
    const double x[] = {nodes.a.x, nodes.b.x, nodes.centre.x};
    const int node[] = {t, (t + 1) % 4, 4};
    for (int n = 0; n < 3; ++n) {
      strain(0, 2 * node[n]) = strain(2, 2 * node[n] + 1) = grad(0, n);
      strain(1, 2 * node[n] + 1) = strain(2, 2 * node[n]) = grad(1, n);
      if (!rings) continue;
      strain(3, 2 * node[n]) = 1.0 / radii;
      if (x[n] == 0.0) strain.col(2 * node[n]).setZero();
    }
    const double thickness = rings ? 2.0 * M_PI * radii / 3.0 : 1.0;
    stiffness += nodes.area() * thickness * strain.transpose() * elasticity * strain;
  }
  return stiffness;
}

/// Largest omega^2 of K w = omega^2 M w with a diagonal M.
inline double largest_frequency(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& mass) {
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = root.asDiagonal() * stiffness * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// A quad's share of the mass, laid out like its stiffness.
inline Eigen::VectorXd quad_masses(const Body& body, int row, int column) {
  const double areal = elastic_part(body.material(row)).density * body.mesh().rows[row].quad_area;
  Eigen::VectorXd masses = Eigen::VectorXd::Constant(10, areal / 6.0);
  masses.tail<2>().setConstant(areal / 3.0);
  if (!is_of_revolution(body.measure())) return masses;
  const double left = body.mesh().corner_x(column), right = body.mesh().corner_x(column + 1);
  const double middle = 0.5 * (left + right);
  for (int i = 0; i < 10; ++i) {
    masses[i] *= i < 8 ? M_PI * (middle + (i / 2 == 0 || i / 2 == 3 ? left : right)) : 2.0 * M_PI * middle;
  }
  return masses;
}

/// Of a quad alone, with its own share of the mass.
inline double quad_frequency(const Body& body, int row, int column) {
  return largest_frequency(quad_stiffness(body, row, column), quad_masses(body, row, column));
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
      const Eigen::VectorXd mass = quad_masses(body, row, column);
      const int at[] = {(row + 1) * per_row + column, (row + 1) * per_row + column + 1, row * per_row + column + 1,
                        row * per_row + column, corners + row * mesh.columns + column};
      for (int i = 0; i < 10; ++i) {
        masses[2 * at[i / 2] + i % 2] += mass[i];
        for (int j = 0; j < 10; ++j) stiffness(2 * at[i / 2] + i % 2, 2 * at[j / 2] + j % 2) += quad(i, j);
      }
    }
  }
  return largest_frequency(stiffness, masses);
}

}  // namespace grainstep::fe::test
