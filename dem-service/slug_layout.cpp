#include "dem-service/slug_layout.hpp"

#include <cmath>

#include "contact/rest_on.hpp"
#include "dem-service/packing.hpp"

namespace grainstep::dem {

using surface::Vec2;

std::vector<PlacedParticle> lay_out(const SlugModel& model, const surface::Polyline& surface) {
  const double radius = model.diameter / 2.0;
  const PackingBox box{{{model.mirror ? radius : radius - model.half_width, radius}},
                       {{model.half_width - radius, model.height - radius}}};
  std::vector<Vec2> centres = pack_at_random(box, model.particles, model.diameter, model.seed);
  const Vec2 lateral{{std::cos(model.angle), std::sin(model.angle)}};
  const Vec2 ahead{{std::sin(model.angle), -std::cos(model.angle)}};
  std::vector<PlacedParticle> particles;
  particles.reserve(centres.size());
  for (Vec2& centre : centres) {
    const double from_head = centre[1];
    const double speed = model.speed + (model.tail_speed - model.speed) * from_head / model.height;
    centre = Vec2{{model.offset, 0.0}} + centre[0] * lateral - from_head * ahead;
    particles.push_back({centre, speed * ahead, 0.0});
  }
  contact::rest_on(surface, model.diameter, centres);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    particles[i].position = centres[i] + Vec2{{0.0, model.stand_off}};
  }
  return particles;
}

}  // namespace grainstep::dem
