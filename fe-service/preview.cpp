#include "fe-service/preview.hpp"

#include "base/error.hpp"
#include "fe-service/body.hpp"
#include "fe-service/deformable.hpp"
#include "fe-service/foam/model.hpp"
#include "fe-service/layers.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fe {

namespace {

// Measured with bench_fe_kernel (AVX-512, one core); a layer that may flow is taken to do so everywhere.
constexpr double kElasticSeconds = 1.0 / 200e6;
constexpr double kPlasticSeconds = 1.0 / 80e6;
constexpr double kCoreSeconds = 1.0 / 80e6;
constexpr double kFoamSeconds = 1.0 / 80e6;

double seconds_of(const Material& material) {
  if (std::holds_alternative<Core>(material)) return kCoreSeconds;
  return std::holds_alternative<Dh36>(material) ? kPlasticSeconds : kElasticSeconds;
}

double seconds_per_element_step(const Mesh& mesh, const std::vector<Material>& layers) {
  double sum = 0.0;
  for (const ElementRow& row : mesh.rows) {
    sum += seconds_of(layers[row.layer]);
  }
  return sum / static_cast<double>(mesh.rows.size());
}

void preview_beam(const scene::Structure& structure, double depth, StructurePreview& found) {
  const Mesh mesh = make_mesh(structure);
  const std::vector<Material> layers = make_layers(structure);
  found.elements = mesh.triangles();
  found.nodes = mesh.nodes();
  found.element_size = mesh.width;
  // All columns are alike: one is enough for the step, and tells what each adds to the memory.
  Mesh column = mesh;
  column.columns = 1;
  column.length = mesh.width;
  const Body body(column, layers, depth);
  found.stable_step = body.stable_step();
  found.preferred_step = kStepSafety * found.stable_step;
  // The only column's two surface nodes have one triangle's neighbourhood each; inside the surface nodes have both.
  for (const Corner c : body.mesh().surface()) found.contact_mass += body.corners.mass[body.mesh().corner(c)];
  found.memory_bytes = body.memory_bytes() * mesh.batches();
  found.seconds_per_element_step = seconds_per_element_step(mesh, layers);
}

}  // namespace

StructurePreview preview(const scene::Structure& structure, scene::Symmetry symmetry, double depth) {
  if (symmetry != scene::SYMMETRY_PLANE_STRAIN) throw InputError("symmetry: grainstep-fe knows `plane_strain` only");
  if (structure.layers().empty()) throw InputError("structure.layers: none given; at least one is needed");
  StructurePreview found;
  found.yield_strength = structure.layers(0).yield_strength();
  found.density = structure.layers(0).density();
  for (const scene::Layer& layer : structure.layers()) found.areal_mass += layer.density() * layer.thickness();
  if (structure.type() == scene::Structure::TYPE_RIGID) {
    found.stable_step = found.preferred_step = participant::no_step_limit;
  } else {
    preview_beam(structure, depth, found);
  }
  return found;
}

FoamPreview preview_foam(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth, bool mirror) {
  if (symmetry != scene::SYMMETRY_PLANE_STRAIN)
    throw InputError("symmetry: a foam projectile is computed in `plane_strain` only; take impactor.type: slug");
  const FoamModel model = make_foam_model(impactor, depth, mirror);
  // All quads are alike: one is enough for the step.
  Mesh quad = model.mesh;
  quad.columns = 1;
  quad.length = quad.width;
  quad.rows.resize(1);
  quad.level.resize(2);
  const Body body(quad, {model.foam}, depth);
  FoamPreview found;
  found.elements = model.mesh.triangles();
  found.stable_step = stable_step_in_touch(model, body.stable_step());
  found.preferred_step = preferred_foam_step(impactor, found.stable_step);
  found.contact_mass = 2.0 * body.corners.mass[0];
  found.memory_bytes = body.memory_bytes() * model.mesh.batches() * model.mesh.rows.size();
  found.seconds_per_element_step = kFoamSeconds;
  return found;
}

}  // namespace grainstep::fe
