#include "scene/groups.hpp"

#include <cmath>

#include "base/assert.hpp"

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

Groups groups(const Scene& scene) {
  GS_ASSERT(scene.structure().layers_size() > 0, "a structure without layers passed the loader");
  const auto& slug = scene.impactor().slug();
  const auto& face = scene.structure().layers(0);
  const double rho_bar = slug.relative_density();
  const double rho_s = slug.particle().density();
  Groups g;
  const double tail_speed = slug.has_tail_speed() ? slug.tail_speed() : slug.speed();
  g.areal_momentum = areal_momentum(rho_bar, rho_s, slug.height(), 0.5 * (slug.speed() + tail_speed));
  g.areal_mass = areal_mass(scene.structure());
  g.impulse_number = impulse_number(g.areal_momentum, g.areal_mass, face.yield_strength(), face.density());
  g.areal_mass_ratio = areal_mass_ratio(rho_bar, rho_s, slug.height(), g.areal_mass);
  g.width_ratio = slug.half_width() / scene.structure().half_span();
  g.reference_time = reference_time(scene.structure().half_span(), face.density(), face.yield_strength());
  g.slug_time = slug.height() / slug.speed();
  g.arrival = slug.stand_off() > 0 ? slug.stand_off() / slug.speed() : 0;
  g.loading_time_ratio = loading_time_ratio(g.slug_time, g.reference_time);
  g.slug_pressure = rho_bar * rho_s * slug.speed() * slug.speed();
  g.end = seconds(scene.time().end(), g.reference_time);
  return g;
}

}  // namespace grainstep::scene
