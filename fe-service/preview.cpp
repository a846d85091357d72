#include "fe-service/preview.hpp"

#include "base/error.hpp"
#include "fe-service/body.hpp"
#include "fe-service/deformable.hpp"
#include "fe-service/foam/block.hpp"
#include "fe-service/layers.hpp"
#include "fe-service/rigid.hpp"
#include "fe-service/solid.hpp"

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
  for (const Corner c : body.mesh().surface()) found.contact_mass += body.corners.mass[body.mesh().corner(c)];
}

void preview_deformable(const scene::Structure& structure, const Measure& measure, StructurePreview& found) {
  const Mesh mesh = make_mesh(structure);
  const std::vector<Material> layers = make_layers(structure);
  found.elements = mesh.triangles();
  found.nodes = mesh.nodes();
  found.element_size = mesh.width;
  found.memory_bytes = memory_bytes(mesh, layers);
  if (is_of_revolution(measure)) {
    preview_plate(mesh, layers, bulk_factors(structure), found);
  } else {
    preview_beam(mesh, layers, measure, bulk_factors(structure), found);
  }
  found.preferred_step = kStepSafety * found.stable_step;
  found.seconds_per_element_step = seconds_per_element_step(mesh, layers);
}

}  // namespace

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
