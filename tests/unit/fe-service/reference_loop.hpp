/// @file The element loop once more, as plainly as it can be written: one triangle after the other, strain-displacement
/// matrices, rotation matrices, bisection. What the kernel computes is measured against it.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "fe-service/body.hpp"

namespace grainstep::fe::test {

struct ReferenceTriangle {
  int row, column, triangle;
  int nodes[3];
  double area0;
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d increment = Eigen::Matrix3d::Zero();  ///< of strain
  Eigen::Matrix3d spin = Eigen::Matrix3d::Zero();
  double middle_volume = 0.0;
  double plastic_strain = 0.0;
};

class ReferenceLoop {
 public:
  explicit ReferenceLoop(const Body& body) : body_(&body) {
    const Mesh& mesh = body.mesh();
    const int per_row = mesh.columns + 1;
    const int corners = per_row * (mesh.row_count() + 1);
    for (int row = 0; row < mesh.row_count(); ++row) {
      for (int column = 0; column < mesh.columns; ++column) {
        const int ring[] = {(row + 1) * per_row + column, (row + 1) * per_row + column + 1, row * per_row + column + 1,
                            row * per_row + column};
        for (int t = 0; t < 4; ++t) {
          triangles.push_back({row,
                               column,
                               t,
                               {ring[t], ring[(t + 1) % 4], corners + row * mesh.columns + column},
                               0.25 * mesh.rows[row].quad_area});
        }
      }
    }
    node_count_ = corners + mesh.columns * mesh.row_count();
  }

  /// Positions at the end of the step and displacements during it are those of the body.
  void sweep(double step) {
    force.assign(node_count_, Eigen::Vector2d::Zero());
    plastic_work = 0.0;
    for (ReferenceTriangle& triangle : triangles) strain(triangle, step);
    for (std::size_t first = 0; first < triangles.size(); first += 4) share_dilatation(&triangles[first]);
    for (ReferenceTriangle& triangle : triangles) update(triangle, step);
    for (std::size_t first = 0; first < triangles.size(); first += 4) pull(&triangles[first]);
  }

  std::vector<ReferenceTriangle> triangles;
  std::vector<Eigen::Vector2d> force;
  double plastic_work = 0.0;

  [[nodiscard]] Eigen::Vector2d kernel_force(int node) const {
    return {pick(body_->corners.fx, body_->centres.fx, node), pick(body_->corners.fy, body_->centres.fy, node)};
  }

 private:
  [[nodiscard]] double pick(const Array& corner, const Array& centre, int node) const {
    const Mesh& mesh = body_->mesh();
    const int corners = (mesh.columns + 1) * (mesh.row_count() + 1);
    if (node < corners) return corner[mesh.corner({node / (mesh.columns + 1), node % (mesh.columns + 1)})];
    return centre[(node - corners) / mesh.columns * mesh.centre_stride() + (node - corners) % mesh.columns];
  }

  /// Rows: gradients of the three shape functions. Returns the area.
  static double gradients(const Eigen::Vector2d x[3], Eigen::Matrix<double, 3, 2>& grad) {
    Eigen::Matrix3d system;
    for (int n = 0; n < 3; ++n) system.row(n) << 1.0, x[n].x() - x[2].x(), x[n].y() - x[2].y();
    grad = system.inverse().bottomRows<2>().transpose();
    return 0.5 * system.determinant();
  }

  /// Depth, or the way of the centroid around the axis.
  [[nodiscard]] double thickness_of(const Eigen::Vector2d x[3]) const {
    return fe::thickness(body_->measure(), (x[0].x() + x[1].x() + x[2].x()) / 3.0);
  }

  void strain(ReferenceTriangle& t, double step) {
    Eigen::Vector2d end[3], moved[3], middle[3];
    for (int n = 0; n < 3; ++n) {
      end[n] = {pick(body_->corners.x, body_->centres.x, t.nodes[n]),
                pick(body_->corners.y, body_->centres.y, t.nodes[n])};
      moved[n] = step * Eigen::Vector2d(pick(body_->corners.u, body_->centres.u, t.nodes[n]),
                                        pick(body_->corners.v, body_->centres.v, t.nodes[n]));
      middle[n] = end[n] - 0.5 * moved[n];
    }
    Eigen::Matrix<double, 3, 2> grad;
    const double middle_area = gradients(middle, grad);
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    for (int n = 0; n < 3; ++n) gradient.topLeftCorner<2, 2>() += moved[n] * grad.row(n);
    if (is_of_revolution(body_->measure())) {
      gradient(2, 2) = (moved[0] + moved[1] + moved[2]).x() / (middle[0] + middle[1] + middle[2]).x();
    }
    t.increment = 0.5 * (gradient + gradient.transpose());
    t.spin = 0.5 * (gradient - gradient.transpose());
    t.middle_volume = middle_area * thickness_of(middle);
  }

  /// Rings: all four triangles of a quad get the quad's change of volume.
  void share_dilatation(ReferenceTriangle* quad) const {
    if (!is_of_revolution(body_->measure())) return;
    double volume = 0.0, change = 0.0;
    for (int t = 0; t < 4; ++t) {
      volume += quad[t].middle_volume;
      change += quad[t].middle_volume * quad[t].increment.trace();
    }
    for (int t = 0; t < 4; ++t) {
      quad[t].increment += (change / volume - quad[t].increment.trace()) / 3.0 * Eigen::Matrix3d::Identity();
    }
  }

  void update(ReferenceTriangle& t, double step) {
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d& strain = t.increment;
    const Eigen::Matrix3d turn = (one - 0.5 * t.spin).inverse() * (one + 0.5 * t.spin);
    const Eigen::Matrix3d old = turn * t.stress * turn.transpose();
    const Elastic& elastic = elastic_part(body_->material(t.row));
    // The increment belongs to the middle of the step: it turns by half the angle.
    const double half = 0.5 * std::atan2(turn(1, 0), turn(0, 0));
    const Eigen::Matrix3d on = Eigen::AngleAxisd(half, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    t.stress = old + on * (elastic.lambda * strain.trace() * one + 2.0 * elastic.mu * strain) * on.transpose();
    if (const auto* steel = std::get_if<Dh36>(&body_->material(t.row))) flow(*steel, old, t, step);
  }

  /// Forces of a quad's four triangles.
  void pull(const ReferenceTriangle* quad) {
    const bool rings = is_of_revolution(body_->measure());
    Eigen::Vector2d x[4][3];
    Eigen::Matrix<double, 3, 2> grad[4];
    double area[4], volume = 0.0, pressure = 0.0;
    for (int t = 0; t < 4; ++t) {
      for (int n = 0; n < 3; ++n) {
        x[t][n] = {pick(body_->corners.x, body_->centres.x, quad[t].nodes[n]),
                   pick(body_->corners.y, body_->centres.y, quad[t].nodes[n])};
      }
      area[t] = gradients(x[t], grad[t]);
      volume += area[t] * thickness_of(x[t]);
      pressure -= area[t] * thickness_of(x[t]) * quad[t].stress.trace() / 3.0;
    }
    for (int t = 0; t < 4; ++t) {
      Eigen::Matrix3d stress = quad[t].stress;
      if (rings) stress -= (pressure / volume + stress.trace() / 3.0) * Eigen::Matrix3d::Identity();
      for (int n = 0; n < 3; ++n) {
        force[quad[t].nodes[n]] -=
            thickness_of(x[t]) * area[t] * stress.topLeftCorner<2, 2>() * grad[t].row(n).transpose();
        if (rings) force[quad[t].nodes[n]].x() -= 2.0 * M_PI * area[t] / 3.0 * stress(2, 2);
      }
    }
  }

  void flow(const Dh36& law, const Eigen::Matrix3d& old, ReferenceTriangle& t, double step) {
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d s = t.stress - t.stress.trace() / 3.0 * one;
    const double q = std::sqrt(1.5) * s.norm();
    const auto residual = [&](double d) {
      const double rate = std::max(1.0, d / step / law.reference_rate);
      return q - 3.0 * law.elastic.mu * d -
             law.yield_strength *
                 (1.0 + law.hardening_factor * std::pow(t.plastic_strain + d, law.hardening_exponent)) *
                 (1.0 + law.rate_factor * std::log(rate));
    };
    if (residual(0.0) <= 0.0) return;
    double low = 0.0;
    double high = q / (3.0 * law.elastic.mu);
    for (int i = 0; i < 200; ++i) (residual(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    const Eigen::Matrix3d plastic = 1.5 * low / q * s;
    t.stress -= 2.0 * law.elastic.mu * plastic;
    t.plastic_strain += low;
    plastic_work += 0.5 * (old + t.stress).cwiseProduct(plastic).sum() * t.middle_volume;
  }

  const Body* body_;
  int node_count_ = 0;
};

}  // namespace grainstep::fe::test
