/// @file A body moved by hand, without the conversation of a run.
#pragma once

#include <cmath>

#include "fe-service/layers.hpp"
#include "fe-service/observe.hpp"

namespace grainstep::fe::test {

[[nodiscard]] inline Body body_of(const scene::Structure& structure) {
  return {make_mesh(structure), make_layers(structure), PlaneStrain{1e-3}};
}

/// Calls action(nodes, index) for every node with mass.
template <class Action>
void for_each_node(Body& body, Action action) {
  for (Nodes* nodes : {&body.corners, &body.centres}) {
    for (std::size_t i = 0; i < nodes->x.size(); ++i) {
      if (nodes->mass[i] > 0.0) action(*nodes, i);
    }
  }
}

/// Velocities that take every node from where it is to target(x, y) within a step.
template <class Target>
void head_for(Body& body, double step, Target target) {
  for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const Vec2 goal = target(nodes.x[i], nodes.y[i]);
    nodes.u[i] = (goal.x - nodes.x[i]) / step;
    nodes.v[i] = (goal.y - nodes.y[i]) / step;
  });
}

/// Velocities that take a block within a step to `height` times its own in its material frame, turned by `angle`.
inline void crush_and_turn(Body& body, double height, double angle, double step) {
  for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    const double x = nodes.x0[i];
    const double y = height * nodes.y0[i];
    nodes.u[i] = (std::cos(angle) * x - std::sin(angle) * y - nodes.x[i]) / step;
    nodes.v[i] = (std::sin(angle) * x + std::cos(angle) * y - nodes.y[i]) / step;
  });
}

/// What keeps a body as it is told in its steps. The weight of the first kick is half a step: it starts at t = 0.
class Stepper {
 public:
  Stepper(Body& body, double step) : body_(body), step_(step) {}

  /// hold(body) corrects the velocities of the step: supports, symmetry, forces from outside.
  template <class Hold>
  SweepResult operator()(Hold hold) {
    body_.kick(steps_ == 0 ? 0.5 * step_ : step_);
    hold(body_);
    body_.drift(step_);
    ++steps_;
    return body_.sweep(step_);
  }

  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] double time() const { return step_ * steps_; }  ///< s, of positions and stresses

 private:
  Body& body_;
  double step_;
  int steps_ = 0;
};

/// Calls action(row, column, triangle) for all.
template <class Action>
void for_each_triangle(const Body& body, Action action) {
  for (int row = 0; row < body.mesh().row_count(); ++row) {
    for (int column = 0; column < body.mesh().columns; ++column) {
      for (int triangle = 0; triangle < kQuadTriangles; ++triangle) action(row, column, triangle);
    }
  }
}

}  // namespace grainstep::fe::test
