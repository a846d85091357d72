#include "dem-service/slug_layout.hpp"

#include <cmath>

#include "contact/rest_on.hpp"
#include "dem-service/packing.hpp"

namespace grainstep::dem {

using surface::in_space;
using surface::Vec2;
using surface::Vec3;

namespace {

double speed_at(const SlugModel& model, double from_head) {
  return model.speed + (model.tail_speed - model.speed) * from_head / model.height;
}

std::vector<PlacedParticle> discs(const SlugModel& model) {
  const double radius = model.diameter / 2.0;
  const PackingBox box{{{model.mirror ? radius : radius - model.half_width, radius}},
                       {{model.half_width - radius, model.height - radius}}};
  const Vec2 lateral{{std::cos(model.angle), std::sin(model.angle)}};
  const Vec2 ahead{{std::sin(model.angle), -std::cos(model.angle)}};
  std::vector<PlacedParticle> particles;
  particles.reserve(model.particles);
  for (const Vec2& centre : pack_at_random(box, model.particles, model.diameter, model.seed)) {
    const double from_head = centre[1];
    const Vec2 place = Vec2{{model.offset, 0.0}} + centre[0] * lateral - from_head * ahead;
    particles.push_back({in_space(place), in_space(speed_at(model, from_head) * ahead), 0.0});
  }
  return particles;
}

std::vector<PlacedParticle> spheres(const SlugModel& model) {
  const double radius = model.diameter / 2.0;
  const PackingSlice slice{.outer = model.half_width - radius,
                           .low = radius,
                           .high = model.height - radius,
                           .angle = model.slice,
                           .wall_gap = radius};
  std::vector<PlacedParticle> particles;
  particles.reserve(model.particles);
  for (const Vec3& centre : pack_at_random(slice, model.particles, model.diameter, model.seed)) {
    particles.push_back({centre, {{0.0, -speed_at(model, centre[1]), 0.0}}, 0.0});
  }
  return particles;
}

}  // namespace

std::vector<PlacedParticle> lay_out(const SlugModel& model, const surface::Polyline& surface) {
  std::vector<PlacedParticle> particles = model.spheres() ? spheres(model) : discs(model);
  std::vector<Vec2> centres;
  centres.reserve(particles.size());
  for (const PlacedParticle& particle : particles) {
    const Vec3& x = particle.position;
    centres.push_back({{model.spheres() ? std::hypot(x[0], x[2]) : x[0], x[1]}});
  }
  contact::rest_on(surface, model.diameter, centres);
  for (std::size_t i = 0; i < centres.size(); ++i) particles[i].position[1] = centres[i][1] + model.stand_off;
  return particles;
}

}  // namespace grainstep::dem
