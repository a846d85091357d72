/// @file A body moved by hand, without the conversation of a run.
#pragma once

#include <cmath>

#include "fe-service/observe.hpp"

namespace grainstep::fe::test {

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
