#include "scene/bulk_viscosity.hpp"

#include <algorithm>
#include <cmath>

#include "load/pressure_history.hpp"

namespace grainstep::scene {
namespace {

/// Of the material whose flow the front would overdo; infinite where nothing but cores and elastic layers are.
double lowest_yield_strength(const Structure& structure) {
  double lowest = HUGE_VAL;
  for (const Layer& layer : structure.layers()) {
    const bool yields = layer.material() != Layer::MATERIAL_ELASTIC && layer.material() != Layer::MATERIAL_CORE;
    if (yields) lowest = std::min(lowest, layer.yield_strength());
  }
  return lowest;
}

/// Elements have the size of (half the only layer's, or the first layer's) thickness over refinement.
double crossing_time(const Structure& structure) {
  const Layer& layer = structure.layers(0);
  const double size = layer.thickness() / (structure.layers_size() == 1 ? 2.0 : 1.0) / structure.mesh().refinement();
  const double nu = layer.poisson();
  const double modulus = layer.young() * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return size / std::sqrt(modulus / layer.density());
}

/// Largest change of a table's pressure within `time`. It begins or ends at one of the points.
double largest_change(const Pressure& pressure, double time) {
  double largest = 0.0;
  for (const double point : pressure.tabulated().time()) {
    const double now = load::pressure_at(pressure, point);
    largest = std::max({largest, std::abs(now - load::pressure_at(pressure, point - time)),
                        std::abs(load::pressure_at(pressure, point + time) - now)});
  }
  return largest;
}

double sudden_change(const Scene& scene) {
  const Pressure& pressure = scene.impactor().pressure();
  if (pressure.has_rectangular()) return std::abs(pressure.rectangular().pressure());
  if (pressure.has_exponential()) return std::abs(pressure.exponential().peak());
  return largest_change(pressure, elements_of_a_sudden_front * crossing_time(scene.structure()));
}

}  // namespace

bool strikes_suddenly(const Scene& scene) {
  const Structure& structure = scene.structure();
  const bool deforms = structure.type() == Structure::TYPE_BEAM || structure.type() == Structure::TYPE_PLATE;
  if (scene.impactor().type() != Impactor::TYPE_PRESSURE || !deforms) return false;
  return sudden_change(scene) > lowest_yield_strength(structure);
}

void check_bulk_viscosity(const Scene& scene, std::vector<Finding>& findings) {
  const BulkViscosity& factors = scene.structure().bulk_viscosity();
  const bool given = factors.linear() > 0.0 || factors.quadratic() > 0.0;
  if (given && scene.structure().type() == Structure::TYPE_RIGID) {
    findings.push_back({Severity::error, "structure.bulk_viscosity",
                        "nobody would read it: a rigid target has no elements; leave it out, or take another "
                        "structure.type"});
  }
  if (given || !strikes_suddenly(scene)) return;
  findings.push_back(
      {Severity::warning, "impactor.pressure",
       "changes by more than the yield strength within ten elements: they ring, and plastic strains come "
       "out up to a tenth too large. Refine the mesh; where the pressure holds, {linear: 0.06, "
       "quadratic: 1.2} for structure.bulk_viscosity calms them (of a short pulse it would take too much)"});
}

}  // namespace grainstep::scene
