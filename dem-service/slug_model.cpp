#include "dem-service/slug_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/error.hpp"
#include "dem-service/packing.hpp"

namespace grainstep::dem {
namespace {

constexpr double most_particles = std::numeric_limits<int>::max();  // LAMMPS's own numbers of particles

void check(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth, bool mirror) {
  std::ostringstream text;
  const scene::Slug& slug = impactor.slug();
  const double diameter = slug.particle().diameter();
  if (impactor.type() != scene::Impactor::TYPE_SLUG) {
    text << "impactor.type: grainstep-dem computes a slug, not " << scene::Impactor::Type_Name(impactor.type());
  } else if (symmetry != scene::SYMMETRY_PLANE_STRAIN) {
    text << "symmetry: grainstep-dem computes plane_strain, not " << scene::Symmetry_Name(symmetry);
  } else if (!(depth > 0.0)) {
    text << "depth: found " << depth << " m, expected more than 0";
  } else if (!(diameter > 0.0) || !(slug.particle().density() > 0.0) || !(slug.particle().normal_stiffness() > 0.0)) {
    text << "impactor.slug.particle: diameter, density and normal_stiffness must be above 0, found " << diameter
         << " m, " << slug.particle().density() << " kg/m^3, " << slug.particle().normal_stiffness() << " N/m";
  } else if (slug.relative_density() > densest_random_packing) {
    text << "impactor.slug.relative_density: found " << slug.relative_density()
         << ", but random sequential addition of discs jams near 0.547 and is offered up to " << densest_random_packing
         << ": choose a smaller fraction";
  } else if (!(slug.half_width() > diameter) || !(slug.height() > diameter)) {
    text << "impactor.slug: half_width " << slug.half_width() << " m and height " << slug.height()
         << " m must exceed the particle diameter, " << diameter << " m";
  } else if (mirror && (slug.angle() != 0.0 || slug.offset() != 0.0)) {
    text << "impactor.slug: angle " << slug.angle() << " and offset " << slug.offset()
         << " m have no mirror image: take structure.extent: full";
  } else if (slug.confined() && (slug.angle() != 0.0 || slug.offset() != 0.0)) {
    text << "impactor.slug.confined: the walls stand at |x1| = half_width, the slug must move between them: angle and "
            "offset must be 0";
  }
  if (!text.str().empty()) throw InputError(text.str());
}

}  // namespace

SlugModel make_slug_model(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth, bool mirror) {
  check(impactor, symmetry, depth, mirror);
  const scene::Slug& slug = impactor.slug();
  const scene::Particle& particle = slug.particle();
  const scene::SurfaceContact& contact = slug.surface_contact();
  SlugModel model;
  model.half_width = slug.half_width();
  model.height = slug.height();
  model.speed = slug.speed();
  model.relative_density = slug.relative_density();
  model.seed = slug.seed();
  model.mirror = mirror;
  model.angle = slug.angle();
  model.offset = slug.offset();
  model.stand_off = slug.stand_off();
  model.tail_speed = slug.has_tail_speed() ? slug.tail_speed() : slug.speed();
  model.confined = slug.confined();
  model.diameter = particle.diameter();
  const double section = std::numbers::pi * model.diameter * model.diameter / 4.0;
  model.mass = particle.density() * depth * section;
  const double width = (mirror ? 1.0 : 2.0) * model.half_width;
  const double particles = std::round(model.relative_density * width * model.height / section);
  if (!(particles <= most_particles)) {
    std::ostringstream text;
    text << "impactor.slug: " << particles << " particles of " << model.diameter << " m, but LAMMPS counts up to "
         << most_particles << ": choose a larger particle.diameter";
    throw InputError(text.str());
  }
  model.particles = static_cast<std::uint64_t>(particles);
  if (model.particles == 0) throw InputError("impactor.slug.relative_density: so small that no particle is left");

  const double kn = particle.normal_stiffness();
  model.pair_law = {kn, kn * particle.tangential_ratio(), 0.0, particle.friction(), false};
  model.surface_law = model.pair_law;
  model.surface_law.friction = contact.has_friction() ? contact.friction() : particle.friction();
  model.surface_law.tension_cutoff = contact.tension_cutoff();
  model.lever_is_radius = contact.lever_arm() == scene::SurfaceContact::LEVER_ARM_RADIUS;
  model.pair = {kn, model.mass / 2.0, particle.restitution(), false};
  model.on_surface = {kn, model.mass, contact.has_restitution() ? contact.restitution() : particle.restitution(),
                      contact.tension_cutoff()};
  model.contact_time = contact_time(model.pair);
  model.stable_step = largest_stable_step(model.pair, model.pair_law.tangential_stiffness);
  model.preferred_step = std::min(model.contact_time / 10.0, model.stable_step);
  return model;
}

ContactLaw calibrated_pair_law(const SlugModel& model, double dt) {
  ContactLaw law = model.pair_law;
  law.damping_rate = calibrated_damping(model.pair, dt);
  return law;
}

ContactLaw calibrated_surface_law(const SlugModel& model, double dt) {
  ContactLaw law = model.surface_law;
  law.damping_rate = calibrated_damping(model.on_surface, dt);
  return law;
}

double largest_stable_step(const Collision& pair, double tangential_stiffness) {
  const double mass = 2.0 * pair.effective_mass;
  const double stiffest = (6.0 * pair.stiffness + 18.0 * tangential_stiffness) / mass;
  const double half_rate = 3.0 * continuum_damping(pair);
  // Positive root of stiffest dt^2 + 2 half_rate dt = 4, in the form that does not cancel.
  return 4.0 / (half_rate + std::sqrt(half_rate * half_rate + 4.0 * stiffest));
}

}  // namespace grainstep::dem
