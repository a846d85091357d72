#include "dem-service/slug/layout.hpp"

#include <cmath>

#include "contact/rest_on.hpp"
#include "dem-service/slug/packing.hpp"

namespace grainstep::dem {

using surface::in_space;
using surface::Vec2;
using surface::Vec3;

namespace {

double speed_at(const SlugModel& model, double from_head) {
  return model.speed + (model.tail_speed - model.speed) * from_head / model.height;
}

/// The largest first.
std::vector<double> diameters_of(const SlugModel& model) {
  std::vector<double> diameters = model.sizes.descending(model.particles);
  const double scale = model.scale_of_sizes();
  for (double& diameter : diameters) diameter *= scale * model.diameter;
  return diameters;
}

std::vector<PlacedParticle> discs(const SlugModel& model) {
  const PackingBox box{{{model.mirror ? 0.0 : -model.half_width, 0.0}}, {{model.half_width, model.height}}};
  const Vec2 lateral{{std::cos(model.angle), std::sin(model.angle)}};
  const Vec2 ahead{{std::sin(model.angle), -std::cos(model.angle)}};
  const std::vector<double> diameters = diameters_of(model);
  std::vector<PlacedParticle> particles;
  particles.reserve(model.particles);
  for (const Vec2& centre : pack_at_random(box, diameters, model.seed)) {
    const double from_head = centre[1];
    const Vec2 place = Vec2{{model.offset, 0.0}} + centre[0] * lateral - from_head * ahead;
    const double diameter = diameters[particles.size()];
    particles.push_back({in_space(place), in_space(speed_at(model, from_head) * ahead), 0.0, diameter});
  }
  return particles;
}

std::vector<PlacedParticle> spheres(const SlugModel& model) {
  const PackingSlice slice{.outer = model.half_width, .low = 0.0, .high = model.height, .angle = model.slice};
  const std::vector<double> diameters = diameters_of(model);
  std::vector<PlacedParticle> particles;
  particles.reserve(model.particles);
  for (const Vec3& centre : pack_at_random(slice, diameters, model.seed)) {
    const double diameter = diameters[particles.size()];
    particles.push_back({centre, {{0.0, -speed_at(model, centre[1]), 0.0}}, 0.0, diameter});
  }
  return particles;
}

}  // namespace

std::vector<PlacedParticle> lay_out(const SlugModel& model, const surface::Polyline& surface) {
  std::vector<PlacedParticle> particles = model.spheres() ? spheres(model) : discs(model);
  std::vector<Vec2> centres;
  std::vector<double> radii;
  centres.reserve(particles.size());
  radii.reserve(particles.size());
  for (const PlacedParticle& particle : particles) {
    const Vec3& x = particle.position;
    centres.push_back({{model.spheres() ? std::hypot(x[0], x[2]) : x[0], x[1]}});
    radii.push_back(particle.diameter / 2.0);
  }
  contact::rest_on(surface, radii, centres);
  for (std::size_t i = 0; i < centres.size(); ++i) particles[i].position[1] = centres[i][1] + model.stand_off;
  return particles;
}

}  // namespace grainstep::dem
