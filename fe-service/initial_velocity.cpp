#include "fe-service/initial_velocity.hpp"

#include <algorithm>

#include "scene/groups.hpp"

namespace grainstep::fe {
namespace {

/// A rectangle of one layer: x1 and depth below the loaded face, m.
struct Box {
  scene::Span along, below;
  int layer;
};

double part(bool given, const scene::Span& whole, const scene::Range& range) {
  return given ? scene::common_part(whole, range).length() / whole.length() : 1.0;
}

/// The same of an area that goes by the measure.
double part_along(bool given, const scene::Span& whole, const scene::Range& range, const Measure& measure) {
  if (!given) return 1.0;
  const scene::Span common = scene::common_part(whole, range);
  return part(given, whole, range) * thickness(measure, common.middle()) / thickness(measure, whole.middle());
}

/// How much of the box a field covers, 0 to 1.
double covered(const scene::InitialVelocity& field, const Box& box, const Measure& measure) {
  if (field.has_layer() && static_cast<int>(field.layer()) != box.layer) return 0.0;
  return part_along(field.has_patch(), box.along, field.patch(), measure) *
         part(field.has_depth(), box.below, field.depth());
}

Vec2 velocity_of(const scene::Structure& structure, const Box& box, const Measure& measure) {
  Vec2 sum{0.0, 0.0};
  for (const scene::InitialVelocity& field : structure.initial_velocity())
    sum = sum + covered(field, box, measure) * Vec2{field.x1(), field.x2()};
  return sum;
}

void push(Nodes& nodes, std::size_t at, Vec2 impulse) {
  nodes.u[at] += impulse.x * nodes.inverse_mass[at];
  nodes.v[at] += impulse.y * nodes.inverse_mass[at];
}

}  // namespace

void set_initial_velocity(const scene::Structure& structure, Body& body) {
  if (structure.initial_velocity().empty()) return;
  const Mesh& mesh = body.mesh();
  for (int row = 0; row < mesh.row_count(); ++row) {
    const scene::Span below{-mesh.level[row], -mesh.level[row + 1]};
    for (int column = 0; column < mesh.columns; ++column) {
      const scene::Span along{mesh.corner_x(column), mesh.corner_x(column + 1)};
      const Vec2 velocity = velocity_of(structure, {along, below, mesh.rows[row].layer}, body.measure());
      const std::size_t centre = row * mesh.centre_stride() + column;
      const double third = body.centres.mass[centre];  // of the element's mass: Body::share_mass
      const double middle = body.centres.x0[centre];
      push(body.centres, centre, third * velocity);
      for (const Corner c :
           {Corner{row, column}, Corner{row, column + 1}, Corner{row + 1, column}, Corner{row + 1, column + 1}}) {
        const double share =
            corner_thickness(body.measure(), middle, mesh.corner_x(c.column)) / thickness(body.measure(), middle);
        push(body.corners, mesh.corner(c), 0.5 * third * share * velocity);
      }
    }
  }
  (void)body.hold_supports();
}

Vec2 mean_initial_velocity(const scene::Structure& structure, const Measure& measure) {
  const scene::Span along = scene::loaded_face(structure);
  Vec2 momentum{0.0, 0.0};  // per area
  double mass = 0.0;
  double depth = 0.0;
  for (int layer = 0; layer < structure.layers_size(); ++layer) {
    const double height = structure.layers(layer).thickness();
    const double layer_mass = structure.layers(layer).density() * height;
    momentum = momentum + layer_mass * velocity_of(structure, {along, {depth, depth + height}, layer}, measure);
    mass += layer_mass;
    depth += height;
  }
  return (1.0 / mass) * momentum;
}

}  // namespace grainstep::fe
