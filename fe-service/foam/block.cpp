#include "fe-service/foam/block.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "contact/rest_on.hpp"

namespace grainstep::fe {
namespace {

/// Where a point of the block's frame is, but for the height that first touch decides.
Vec2 turned_into_place(const FoamModel& model, double x, double y) {
  const double c = std::cos(model.angle);
  const double s = std::sin(model.angle);
  return {model.offset + c * x - s * y, s * x + c * y};
}

void set_motion(const FoamModel& model, double rise, Nodes& nodes) {
  const Vec2 ahead{std::sin(model.angle), -std::cos(model.angle)};
  for (std::size_t i = 0; i < nodes.x.size(); ++i) {
    if (!(nodes.mass[i] > 0.0)) continue;
    const double from_head = nodes.y0[i];
    const Vec2 place = turned_into_place(model, nodes.x0[i], from_head);
    const double speed = model.speed + (model.tail_speed - model.speed) * from_head / model.height;
    nodes.x[i] = nodes.x0[i] = place.x;
    nodes.y[i] = nodes.y0[i] = place.y + rise;
    nodes.u[i] = speed * ahead.x;
    nodes.v[i] = speed * ahead.y;
  }
}

/// How far the block has to be lifted for its first node to touch.
double height_of_first_touch(const FoamModel& model, const Body& body, const surface::Polyline& surface) {
  std::vector<surface::Vec2> nodes;
  for (const std::size_t i : outline(model.mesh)) {
    const Vec2 place = turned_into_place(model, body.corners.x0[i], body.corners.y0[i]);
    nodes.push_back({{place.x, place.y}});
  }
  const double before = nodes.front()[1];
  contact::rest_on(surface, std::span(&model.radius, 1), nodes);
  return nodes.front()[1] - before;
}

}  // namespace

Body make_block(const FoamModel& model, const surface::Polyline& surface) {
  Body body(model.mesh, {model.foam}, model.measure);
  const double rise = height_of_first_touch(model, body, surface) + model.stand_off;
  for (Nodes* nodes : {&body.corners, &body.centres}) set_motion(model, rise, *nodes);
  return body;
}

std::vector<std::size_t> outline(const Mesh& mesh) {
  std::vector<std::size_t> nodes;
  const int last = mesh.row_count();
  for (int column = 0; column <= mesh.columns; ++column) nodes.push_back(mesh.corner({last, column}));
  for (int row = last - 1; row > 0; --row) {
    if (!mesh.symmetric) nodes.push_back(mesh.corner({row, 0}));
    nodes.push_back(mesh.corner({row, mesh.columns}));
  }
  for (int column = 0; column <= mesh.columns; ++column) nodes.push_back(mesh.corner({0, column}));
  return nodes;
}

std::vector<double> outline_areas(const Mesh& mesh, const Measure& measure) {
  std::vector<double> all(mesh.corner_stride() * (mesh.rows.size() + 1), 0.0);
  const auto add = [&](Corner a, Corner b, double length) {
    const auto share = [&](Corner here, Corner other) {
      const double resultant = (2.0 * mesh.corner_x(here.column) + mesh.corner_x(other.column)) / 3.0;
      all[mesh.corner(here)] += 0.5 * length * thickness(measure, resultant);
    };
    share(a, b);
    share(b, a);
  };
  for (const int row : {0, mesh.row_count()}) {
    for (int column = 0; column < mesh.columns; ++column) add({row, column}, {row, column + 1}, mesh.width);
  }
  for (int row = 0; row < mesh.row_count(); ++row) {
    if (!mesh.symmetric) add({row, 0}, {row + 1, 0}, mesh.rows[row].height);
    add({row, mesh.columns}, {row + 1, mesh.columns}, mesh.rows[row].height);
  }
  std::vector<double> areas;
  for (const std::size_t i : outline(mesh)) areas.push_back(all[i]);
  return areas;
}

double heaviest_of_face(const Body& body) {
  const auto face =
      body.corners.mass.begin() + static_cast<std::ptrdiff_t>(body.mesh().corner({body.mesh().row_count(), 0}));
  return *std::max_element(face, face + body.mesh().columns + 1);
}

double stable_step_in_touch(const FoamModel& model, const Body& body, double elements) {
  const std::vector<std::size_t> nodes = outline(body.mesh());
  const std::vector<double> areas = outline_areas(body.mesh(), body.measure());
  double most = 0.0;  // m^2/kg
  for (std::size_t k = 0; k < nodes.size(); ++k) most = std::max(most, areas[k] * body.corners.inverse_mass[nodes[k]]);
  return 2.0 / std::sqrt(4.0 / (elements * elements) + model.contact_stiffness * most);
}

Vec2 hold_block(const FoamModel& model, Body& body) {
  Vec2 impulse{0.0, 0.0};
  const auto stop = [&](std::size_t i) {
    impulse.x -= body.corners.mass[i] * body.corners.u[i];
    body.corners.u[i] = 0.0;
  };
  for (int row = 0; row <= model.mesh.row_count(); ++row) {
    if (model.mesh.symmetric || model.confined) stop(model.mesh.corner({row, 0}));
    if (model.confined) stop(model.mesh.corner({row, model.mesh.columns}));
  }
  return impulse;
}

}  // namespace grainstep::fe
