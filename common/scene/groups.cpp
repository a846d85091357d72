#include "scene/groups.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "load/pressure_history.hpp"

namespace grainstep::scene {

double areal_momentum(double relative_density, double material_density, double height, double speed) {
  return relative_density * material_density * height * speed;
}

double areal_mass(const Structure& structure) {
  double sum = 0;
  for (const auto& layer : structure.layers()) sum += layer.density() * layer.thickness();
  return sum;
}

double impulse_number(double areal_momentum, double areal_mass, double yield_strength, double density) {
  return areal_momentum / (areal_mass * std::sqrt(yield_strength / density));
}

double areal_mass_ratio(double relative_density, double material_density, double height, double areal_mass) {
  return relative_density * material_density * height / areal_mass;
}

double reference_time(double half_span, double density, double yield_strength) {
  return half_span * std::sqrt(density / yield_strength);
}

double loading_time_ratio(double slug_time, double reference_time) { return 0.5 * slug_time / reference_time; }

double seconds(const Instant& instant, double reference_time) {
  return instant.has_seconds() ? instant.seconds() : instant.t_bar() * reference_time;
}

const Layer* yielding_layer(const Structure& structure) {
  for (const Layer& layer : structure.layers()) {
    if (layer.material() == Layer::MATERIAL_DH36) return &layer;
    if (layer.material() == Layer::MATERIAL_CORE) return &structure.layers(0);
  }
  return structure.type() == Structure::TYPE_RIGID && structure.layers_size() > 0 ? &structure.layers(0) : nullptr;
}

bool is_described_elsewhere(const Impactor& impactor) {
  return impactor.type() == Impactor::TYPE_EXTERNAL || impactor.type() == Impactor::TYPE_REPLAY;
}

bool is_described_elsewhere(const Structure& structure) {
  return structure.type() == Structure::TYPE_EXTERNAL || structure.type() == Structure::TYPE_REPLAY;
}

bool has_slug(const Scene& scene) {
  const Impactor& impactor = scene.impactor();
  return impactor.type() == Impactor::TYPE_SLUG || impactor.type() == Impactor::TYPE_FOAM ||
         (is_described_elsewhere(impactor) && impactor.has_slug());
}

Span loaded_face(const Structure& structure) {
  const double half_span = structure.half_span();
  return {structure.extent() == Structure::EXTENT_FULL ? -half_span : 0.0, half_span};
}

Span common_part(const Span& whole, const Range& range) {
  const double from = std::max(whole.from, range.from());
  return {from, std::max(from, std::min(whole.to, range.to()))};
}

double area(const Scene& scene, const Span& part) {
  const bool ring = scene.symmetry() == SYMMETRY_AXISYMMETRIC;
  return part.length() * (ring ? 2.0 * std::numbers::pi * part.middle() : scene.depth());
}

bool has_mirror(const Scene& scene) {
  return scene.symmetry() == SYMMETRY_PLANE_STRAIN && scene.structure().extent() == Structure::EXTENT_HALF;
}

namespace {

void add_slug(const Scene& scene, std::optional<double> mass, Groups& g) {
  const auto& slug = scene.impactor().slug();
  g.loaded_width = (scene.structure().extent() == Structure::EXTENT_HALF ? 1.0 : 2.0) * slug.half_width();
  g.loaded_area = area(scene, {0.0, g.loaded_width});
  const double rho_s = slug.particle().density();
  const double rho_bar = mass ? *mass / (rho_s * g.loaded_area * slug.height()) : slug.relative_density();
  const double tail_speed = slug.has_tail_speed() ? slug.tail_speed() : slug.speed();
  g.areal_momentum = areal_momentum(rho_bar, rho_s, slug.height(), 0.5 * (slug.speed() + tail_speed));
  g.areal_mass_ratio = areal_mass_ratio(rho_bar, rho_s, slug.height(), g.areal_mass);
  if (scene.structure().has_half_span()) g.width_ratio = slug.half_width() / scene.structure().half_span();
  g.slug_time = slug.height() / slug.speed();
  // Speeds are linear in the height, so the first to arrive is of the head or, where it is faster, of the tail.
  const double of_head = slug.stand_off() / slug.speed();
  const double of_tail = (slug.stand_off() + slug.height() * std::cos(slug.angle())) / tail_speed;
  g.arrival = slug.stand_off() > 0 ? std::min(of_head, of_tail) / std::cos(slug.angle()) : 0;
  g.loading_time_ratio = loading_time_ratio(g.slug_time, g.reference_time);
  g.slug_pressure = rho_bar * rho_s * slug.speed() * slug.speed();
}

void add_pressure(const Scene& scene, Groups& g) {
  const auto& pressure = scene.impactor().pressure();
  const Span face = loaded_face(scene.structure());
  const Span loaded = pressure.has_patch() ? common_part(face, pressure.patch()) : face;
  g.loaded_width = loaded.length();
  g.loaded_area = area(scene, loaded);
  g.width_ratio = g.loaded_width / face.length();
  const load::Moments moments = load::moments(pressure);
  if (!std::isfinite(moments.impulse) || !(moments.impulse > 0.0)) return;
  g.areal_momentum = moments.impulse;
  // Suction takes its moment off the mean: where that leaves the time of the load, it is no mean of anything.
  const double since_onset = moments.mean_time - moments.onset;
  if (since_onset >= 0.0 && since_onset <= moments.end - moments.onset) {
    g.loading_time_ratio = since_onset / g.reference_time;
  }
}

}  // namespace

Groups groups(const Scene& scene, std::optional<double> slug_mass) {
  const Structure& structure = scene.structure();
  Groups g;
  if (!structure.layers().empty()) g.areal_mass = areal_mass(structure);
  const Layer* metal = yielding_layer(structure);
  if (metal != nullptr && structure.has_half_span()) {
    g.reference_time = reference_time(structure.half_span(), metal->density(), metal->yield_strength());
  }
  if (structure.has_half_span()) {
    g.loaded_width = loaded_face(structure).length();
    g.loaded_area = area(scene, loaded_face(structure));
  }
  if (has_slug(scene) && scene.symmetry() != SYMMETRY_NONE) add_slug(scene, slug_mass, g);
  if (scene.impactor().type() == Impactor::TYPE_PRESSURE && structure.has_half_span()) add_pressure(scene, g);
  if (metal != nullptr) {
    g.impulse_number = impulse_number(g.areal_momentum, g.areal_mass, metal->yield_strength(), metal->density());
  }
  g.end = seconds(scene.time().end(), g.reference_time);
  return g;
}

}  // namespace grainstep::scene
