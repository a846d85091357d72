#include "fe-service/observe.hpp"

#include <algorithm>
#include <cmath>

namespace grainstep::fe {

namespace {

void blend_into(Array& result, const Array& after, double weight) {
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += weight * (after[i] - result[i]);
}

double kinetic(const Array& mass, const Array& u, const Array& v) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * (u[i] * u[i] + v[i] * v[i]);
  return 0.5 * sum;
}

double conserved(const Array& mass, const Array& before, const Array& at) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * before[i] * (2.0 * at[i] - before[i]);
  return 0.5 * sum;
}

double weighted_sum(const Array& mass, const Array& u) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * u[i];
  return sum;
}

/// Calls action(row, column, triangle) for all, in the order of the snapshot's cells.
template <class Action>
void for_each_triangle(const Body& body, Action action) {
  for (int row = 0; row < body.mesh().row_count(); ++row) {
    for (int column = 0; column < body.mesh().columns; ++column) {
      for (int triangle = 0; triangle < kQuadTriangles; ++triangle) action(row, column, triangle);
    }
  }
}

/// Calls action(nodes, index, is_corner) for all, in the order of the snapshot's points.
template <class Action>
void for_each_node(const Body& body, Action action) {
  const Mesh& mesh = body.mesh();
  for (int row = 0; row <= mesh.row_count(); ++row) {
    for (int column = 0; column <= mesh.columns; ++column) action(body.corners, mesh.corner({row, column}), true);
  }
  for (int row = 0; row < mesh.row_count(); ++row) {
    for (int column = 0; column < mesh.columns; ++column) {
      action(body.centres, row * mesh.centre_stride() + column, false);
    }
  }
}

wire::Field& add_field(google::protobuf::RepeatedPtrField<wire::Field>& fields, const char* name, const char* unit,
                       std::uint32_t components) {
  wire::Field& field = *fields.Add();
  field.set_name(name);
  field.set_unit(unit);
  field.set_components(components);
  return field;
}

void fill_points(const Body& body, const Velocities& at, wire::Snapshot& snapshot) {
  wire::Field& velocity = add_field(*snapshot.mutable_point_field(), "velocity", "m/s", 2);
  wire::Field& displacement = add_field(*snapshot.mutable_point_field(), "displacement", "m", 2);
  for_each_node(body, [&](const Nodes& nodes, std::size_t i, bool is_corner) {
    snapshot.add_position(nodes.x[i]);
    snapshot.add_position(nodes.y[i]);
    velocity.add_value(is_corner ? at.corner_u[i] : at.centre_u[i]);
    velocity.add_value(is_corner ? at.corner_v[i] : at.centre_v[i]);
    displacement.add_value(nodes.x[i] - nodes.x0[i]);
    displacement.add_value(nodes.y[i] - nodes.y0[i]);
  });
}

void fill_connectivity(const Mesh& mesh, wire::Snapshot& snapshot) {
  const auto corner = [&mesh](int row, int column) {
    return static_cast<std::uint32_t>(row * (mesh.columns + 1) + column);
  };
  const std::uint32_t corners = corner(mesh.row_count() + 1, 0);
  for (int row = 0; row < mesh.row_count(); ++row) {
    for (int column = 0; column < mesh.columns; ++column) {
      const std::uint32_t ring[] = {corner(row + 1, column), corner(row + 1, column + 1), corner(row, column + 1),
                                    corner(row, column)};
      for (int t = 0; t < kQuadTriangles; ++t) {
        snapshot.add_cell(ring[t]);
        snapshot.add_cell(ring[(t + 1) % kQuadTriangles]);
        snapshot.add_cell(corners + static_cast<std::uint32_t>(row * mesh.columns + column));
      }
    }
  }
}

void fill_cells(const Body& body, wire::Snapshot& snapshot) {
  auto& fields = *snapshot.mutable_cell_field();
  wire::Field& plastic = add_field(fields, "equivalent_plastic_strain", "", 1);
  wire::Field& mises = add_field(fields, "von_mises_stress", "Pa", 1);
  wire::Field& pressure = add_field(fields, "pressure", "Pa", 1);
  wire::Field& layer = add_field(fields, "layer", "", 1);
  for_each_triangle(body, [&](int row, int column, int triangle) {
    const Stress stress = body.stress(row, column, triangle);
    plastic.add_value(body.plastic_strain(row, column, triangle));
    mises.add_value(von_mises(stress));
    pressure.add_value(-mean(stress));
    layer.add_value(body.mesh().rows[row].layer);
  });
}

}  // namespace

Velocities Velocities::of(const Body& body) { return {body.corners.u, body.corners.v, body.centres.u, body.centres.v}; }

Velocities Velocities::blend(const Velocities& before, const Velocities& after, double weight) {
  Velocities result = before;
  blend_into(result.corner_u, after.corner_u, weight);
  blend_into(result.corner_v, after.corner_v, weight);
  blend_into(result.centre_u, after.centre_u, weight);
  blend_into(result.centre_v, after.centre_v, weight);
  return result;
}

double kinetic_energy(const Body& body, const Velocities& at) {
  return kinetic(body.corners.mass, at.corner_u, at.corner_v) + kinetic(body.centres.mass, at.centre_u, at.centre_v);
}

double conserved_kinetic_energy(const Body& body, const Velocities& before, const Velocities& at) {
  return conserved(body.corners.mass, before.corner_u, at.corner_u) +
         conserved(body.corners.mass, before.corner_v, at.corner_v) +
         conserved(body.centres.mass, before.centre_u, at.centre_u) +
         conserved(body.centres.mass, before.centre_v, at.centre_v);
}

Vec2 linear_momentum(const Body& body, const Velocities& at) {
  return {weighted_sum(body.corners.mass, at.corner_u) + weighted_sum(body.centres.mass, at.centre_u),
          weighted_sum(body.corners.mass, at.corner_v) + weighted_sum(body.centres.mass, at.centre_v)};
}

double elastic_energy(const Body& body) {
  double sum = 0.0;
  for_each_triangle(body, [&](int row, int column, int triangle) {
    const auto nodes = body.triangle(row, column, triangle);
    const double centroid = (nodes.a.x + nodes.b.x + nodes.centre.x) / 3.0;
    sum += elastic_part(body.material(row)).stored_energy(body.stress(row, column, triangle)) * nodes.area() *
           thickness(body.measure(), centroid);
  });
  return sum;
}

double max_surface_speed(const Body& body, const Velocities& at) {
  double fastest = 0.0;
  for (const Corner c : body.mesh().surface()) {
    const std::size_t i = body.mesh().corner(c);
    fastest = std::max(fastest, std::hypot(at.corner_u[i], at.corner_v[i]));
  }
  return fastest;
}

PlasticExtent plastic_extent(const Body& body) {
  PlasticExtent extent;
  for_each_triangle(body, [&](int row, int column, int triangle) {
    const double strain = body.plastic_strain(row, column, triangle);
    extent.max_strain = std::max(extent.max_strain, strain);
    extent.elements += strain > 0.0 ? 1 : 0;
  });
  return extent;
}

double back_deflection(const Body& body) {
  const std::size_t i = body.mesh().corner({body.mesh().row_count(), body.mesh().mid_column});
  return body.corners.y0[i] - body.corners.y[i];
}

double front_deflection(const Body& body) {
  const std::size_t i = body.mesh().corner({0, body.mesh().mid_column});
  return body.corners.y0[i] - body.corners.y[i];
}

std::optional<double> core_compression(const Body& body) {
  const Mesh& mesh = body.mesh();
  int first = -1;
  int end = -1;
  for (int row = 0; row < mesh.row_count(); ++row) {
    if (!std::holds_alternative<Core>(body.material(row))) continue;
    if (first < 0) first = row;
    end = row + 1;
  }
  if (first < 0) return std::nullopt;
  const std::size_t top = mesh.corner({first, mesh.mid_column});
  const std::size_t bottom = mesh.corner({end, mesh.mid_column});
  return 1.0 - (body.corners.y[top] - body.corners.y[bottom]) / (body.corners.y0[top] - body.corners.y0[bottom]);
}

void fill_snapshot(const Body& body, const Velocities& at, wire::Snapshot& snapshot) {
  fill_points(body, at, snapshot);
  fill_connectivity(body.mesh(), snapshot);
  fill_cells(body, snapshot);
}

}  // namespace grainstep::fe
