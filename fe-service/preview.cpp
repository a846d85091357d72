#include "fe-service/preview.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "fe-service/body.hpp"
#include "fe-service/deformable.hpp"
#include "fe-service/foam/block.hpp"
#include "fe-service/layers.hpp"
#include "fe-service/rigid.hpp"
#include "fe-service/solid.hpp"
#include "participant/hello.hpp"

namespace grainstep::fe {

namespace {

/// A layer that may flow is taken to do so everywhere.
double seconds_per_element_step(const Mesh& mesh, const std::vector<Material>& layers) {
  double sum = 0.0;
  for (const ElementRow& row : mesh.rows) {
    sum += traits_of(layers[row.layer]).seconds;
  }
  return sum / static_cast<double>(mesh.rows.size());
}

/// One row of quads per layer: rows of a layer are alike.
Mesh one_row_per_layer(const Mesh& mesh) {
  Mesh thin = mesh;
  thin.rows.clear();
  thin.level = {0.0};
  for (const ElementRow& row : mesh.rows) {
    if (!thin.rows.empty() && thin.rows.back().layer == row.layer) continue;
    thin.rows.push_back(row);
    thin.level.push_back(thin.level.back() - row.height);
  }
  return thin;
}

void preview_plate(const Mesh& mesh, const std::vector<Material>& layers, const BulkFactors& bulk,
                   StructurePreview& found) {
  Body body(one_row_per_layer(mesh), layers, Axisymmetric{});
  body.resist_volume(bulk);
  found.stable_step = body.stable_step();
  found.contact_mass = body.corners.mass[body.mesh().corner(mesh.middle_of_face())];
}

void preview_beam(const Mesh& mesh, const std::vector<Material>& layers, const Measure& measure,
                  const BulkFactors& bulk, StructurePreview& found) {
  // All columns are alike: one is enough for the step.
  Mesh column = mesh;
  column.columns = 1;
  column.length = mesh.width;
  Body body(column, layers, measure);
  body.resist_volume(bulk);
  found.stable_step = body.stable_step();
  // The only column's two surface nodes have one triangle's neighbourhood each; inside the surface nodes have both.
  for (const int end : {0, 1}) found.contact_mass += body.corners.mass[body.mesh().corner({0, end})];
}

void fill_surface(const Mesh& mesh, wire::Surface& surface) {
  surface.set_dimension(2);
  std::uint32_t node = 0;
  for (const Corner corner : mesh.surface()) {
    surface.add_position(mesh.corner_x(corner.column));
    surface.add_position(mesh.level[static_cast<std::size_t>(corner.row)]);
    for (int c = 0; c < 2; ++c) surface.add_velocity(0.0);
    if (node > 0) {
      surface.add_facet(node - 1);
      surface.add_facet(node);
    }
    ++node;
  }
}

void preview_deformable(const scene::Structure& structure, const Measure& measure, StructurePreview& found) {
  const Mesh mesh = make_mesh(structure);
  const std::vector<Material> layers = make_layers(structure);
  found.elements = mesh.triangles();
  found.nodes = mesh.nodes();
  found.element_size = mesh.width;
  found.memory_bytes = memory_bytes(mesh, layers);
  fill_surface(mesh, found.surface);
  if (is_of_revolution(measure)) {
    preview_plate(mesh, layers, bulk_factors(structure), found);
  } else {
    preview_beam(mesh, layers, measure, bulk_factors(structure), found);
  }
  found.preferred_step = kStepSafety * found.stable_step;
  found.seconds_per_element_step = seconds_per_element_step(mesh, layers);
}

/// What both kinds of bodies say alike.
void describe_elements(wire::Ready& ready, std::uint64_t elements, double seconds_per_element_step) {
  ready.set_size(elements);
  ready.set_counted("elements");
  ready.set_ledger(wire::FULL);
  ready.set_seconds_per_step(static_cast<double>(elements) * seconds_per_element_step);
}

}  // namespace

wire::Ready StructurePreview::ready() const {
  wire::Ready out;
  describe_elements(out, elements, seconds_per_element_step);
  out.set_stable_step(stable_step);
  out.set_preferred_step(preferred_step);
  out.set_contact_mass(contact_mass);
  out.set_free_mass(free_mass);
  out.set_memory(memory_bytes);
  *out.mutable_surface() = surface;
  if (elements == 0) {
    participant::add_fact(out, "elements", "0: a rigid target, which has no step of its own");
  } else {
    participant::add_fact(
        out, "elements",
        fmt::format("{}, stable step {:.4g} s, element size {:.4g} m", elements, stable_step, element_size));
  }
  return out;
}

wire::Ready FoamPreview::ready() const {
  wire::Ready out;
  describe_elements(out, elements, seconds_per_element_step);
  out.set_stable_step(stable_step);
  out.set_preferred_step(preferred_step);
  out.set_contact_mass(contact_mass);
  out.set_contact_time(contact_time);
  out.set_longest_window(longest_window);
  out.set_memory(memory_bytes);
  participant::add_fact(out, "foam elements", fmt::format("{}, stable step {:.4g} s", elements, stable_step));
  return out;
}

StructurePreview preview(const scene::Structure& structure, scene::Symmetry symmetry, double depth) {
  const Measure measure = make_measure(symmetry, depth);
  check_measure(structure, measure);
  if (structure.layers().empty()) throw InputError("structure.layers: none given; at least one is needed");
  StructurePreview found;
  for (const scene::Layer& layer : structure.layers()) found.areal_mass += layer.density() * layer.thickness();
  if (structure.type() == scene::Structure::TYPE_RIGID) {
    wire::Ready ready;
    Rigid(structure, measure).fill_ready(ready);
    found.stable_step = ready.stable_step();
    found.preferred_step = ready.preferred_step();
    found.free_mass = ready.free_mass();
    found.surface = ready.surface();
  } else {
    preview_deformable(structure, measure, found);
  }
  return found;
}

FoamPreview preview_foam(const scene::Impactor& impactor, const FoamSetting& setting) {
  const FoamModel model = make_foam_model(impactor, setting);
  const Body body(one_row_per_layer(model.mesh), {model.foam}, model.measure);
  FoamPreview found;
  found.elements = model.mesh.triangles();
  found.stable_step = stable_step_in_touch(model, body, body.stable_step());
  found.preferred_step = preferred_foam_step(model, found.stable_step);
  found.contact_time = kFoamStepsPerContact * found.preferred_step;
  found.longest_window = kFoamStepsPerWindow * found.preferred_step;
  found.contact_mass = heaviest_of_face(body);
  found.memory_bytes = memory_bytes(model.mesh, {model.foam});
  found.seconds_per_element_step = Foam::kTraits.seconds;
  return found;
}

}  // namespace grainstep::fe
