#include "dem-service/slug/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <sstream>

#include "base/error.hpp"
#include "contact/moving_surface.hpp"
#include "dem-service/slug/packing.hpp"
#include "surface/disc_overlap.hpp"

namespace grainstep::dem {
namespace {

constexpr double most_slice = 0.5 * std::numbers::pi + 1e-9;        // rad: a quarter of the circle
constexpr double most_particles = std::numeric_limits<int>::max();  // LAMMPS's own numbers of particles

void check_particle(const scene::Particle& particle, std::ostringstream& text) {
  if (particle.diameter() > 0.0 && particle.density() > 0.0 && particle.normal_stiffness() > 0.0) return;
  text << "impactor.slug.particle: diameter, density and normal_stiffness must be above 0, found "
       << particle.diameter() << " m, " << particle.density() << " kg/m^3, " << particle.normal_stiffness() << " N/m";
}

void check_sizes(const scene::Slug& slug, std::ostringstream& text) {
  if (!slug.has_size_distribution()) return;
  for (const scene::SizeProblem& problem : scene::size_problems(slug.size_distribution())) {
    text << (text.str().empty() ? "" : "\n") << "impactor.slug.size_distribution" << (problem.path.empty() ? "" : ".")
         << problem.path << ": " << problem.text;
  }
}

scene::Sizes sizes_of(const scene::Slug& slug, scene::Symmetry symmetry) {
  return {slug, symmetry == scene::SYMMETRY_AXISYMMETRIC ? 3 : 2};
}

/// `largest`: diameter, m.
void check_slice(const scene::Slug& slug, double largest, std::ostringstream& text) {
  if (!(slug.slice_angle() > 0.0) || slug.slice_angle() > most_slice) {
    text << "impactor.slug.slice_angle: found " << slug.slice_angle() << " rad, expected above 0 and up to "
         << most_slice;
  } else if (slug.relative_density() > densest_random_packing_of_spheres) {
    text << "impactor.slug.relative_density: found " << slug.relative_density()
         << ", but random sequential addition of spheres jams near 0.382 and is offered up to "
         << densest_random_packing_of_spheres << ": choose a smaller fraction";
  } else if (slug.angle() != 0.0 || slug.offset() != 0.0 || slug.confined()) {
    text << "impactor.slug: angle, offset and confined are for discs in the plane; a slug of revolution comes along "
            "its axis and spreads freely: leave them out";
  } else if (2.0 * slug.half_width() * std::sin(0.5 * most_slice) < 3.0 * largest) {
    text << "impactor.slug.half_width: found " << slug.half_width() << " m, too few particles of " << largest
         << " m across: a slug of spheres is computed as a slice that is three of them wide at its rim, so it needs at "
            "least "
         << 1.5 * largest / std::sin(0.5 * most_slice)
         << " m, whatever the slice_angle. Take a wider slug or smaller particles; a single one can be computed as a "
            "cylinder, with symmetry: plane_strain";
  } else if (2.0 * slug.half_width() * std::sin(0.5 * slug.slice_angle()) < 3.0 * largest) {
    text << "impactor.slug.slice_angle: the slice is " << 2.0 * slug.half_width() * std::sin(0.5 * slug.slice_angle())
         << " m wide at the slug's rim, expected at least three particle diameters of " << largest
         << " m: take a wider slice or smaller particles";
  }
}

void check_plane(const scene::Slug& slug, double depth, bool mirror, std::ostringstream& text) {
  if (!(depth > 0.0)) {
    text << "depth: found " << depth << " m, expected more than 0";
  } else if (slug.relative_density() > densest_random_packing) {
    text << "impactor.slug.relative_density: found " << slug.relative_density()
         << ", but random sequential addition of discs jams near 0.547 and is offered up to " << densest_random_packing
         << ": choose a smaller fraction";
  } else if (mirror && (slug.angle() != 0.0 || slug.offset() != 0.0)) {
    text << "impactor.slug: angle " << slug.angle() << " and offset " << slug.offset()
         << " m have no mirror image: take structure.extent: full";
  } else if (slug.confined() && (slug.angle() != 0.0 || slug.offset() != 0.0)) {
    text << "impactor.slug.confined: the walls stand at |x1| = half_width, the slug must move between them: angle and "
            "offset must be 0";
  }
}

void check(const scene::Impactor& impactor, scene::Symmetry symmetry, double depth, bool mirror) {
  std::ostringstream text;
  const scene::Slug& slug = impactor.slug();
  if (impactor.type() != scene::Impactor::TYPE_SLUG) {
    text << "impactor.type: grainstep-dem computes a slug, not " << scene::Impactor::Type_Name(impactor.type());
  } else if (symmetry == scene::SYMMETRY_UNSET) {
    text << "symmetry: grainstep-dem computes plane_strain and axisymmetric, not " << scene::Symmetry_Name(symmetry);
  }
  if (text.str().empty()) check_particle(slug.particle(), text);
  if (text.str().empty()) check_sizes(slug, text);
  if (!text.str().empty()) throw InputError(text.str());
  const double diameter = sizes_of(slug, symmetry).largest() * slug.particle().diameter();
  if ((!(slug.half_width() > diameter) || !(slug.height() > diameter))) {
    text << "impactor.slug: half_width " << slug.half_width() << " m and height " << slug.height()
         << " m must exceed the particle diameter, " << diameter << " m";
  }
  if (text.str().empty()) {
    if (symmetry == scene::SYMMETRY_AXISYMMETRIC) {
      check_slice(slug, diameter, text);
    } else {
      check_plane(slug, depth, mirror, text);
    }
  }
  if (!text.str().empty()) throw InputError(text.str());
}

/// Mass and number of the particles.
void set_particles(const scene::Particle& particle, double depth, SlugModel& model) {
  const double d = model.diameter;
  double solid = std::numbers::pi * d * d / 4.0;
  double room = (model.mirror ? 1.0 : 2.0) * model.half_width * model.height;
  if (model.spheres()) {
    solid = std::numbers::pi * d * d * d / 6.0;
    room = 0.5 * model.slice * model.half_width * model.half_width * model.height;
  }
  if (!model.sizes.equal()) solid *= model.sizes.mean_of_power(model.spheres() ? 3 : 2);
  model.density = model.spheres() ? particle.density() : particle.density() * depth;
  model.mass = model.density * solid;
  const double particles = std::round(model.relative_density * room / solid);
  if (!(particles <= most_particles)) {
    std::ostringstream text;
    text << "impactor.slug: " << particles << " particles of " << d << " m, but LAMMPS counts up to " << most_particles
         << ": choose a larger particle.diameter";
    throw InputError(text.str());
  }
  model.particles = static_cast<std::uint64_t>(particles);
  if (!model.sizes.equal()) model.mass = model.density * model.relative_density * room / particles;
  if (model.particles == 0) throw InputError("impactor.slug.relative_density: so small that no particle is left");
}

}  // namespace

double SlugModel::mass_of(double of_diameter) const {
  const double d = of_diameter;
  return density * (spheres() ? std::numbers::pi * d * d * d / 6.0 : std::numbers::pi * d * d / 4.0);
}

double SlugModel::scale_of_sizes() const {
  if (sizes.equal()) return 1.0;
  double of_all = 0.0;
  for (const double size : sizes.descending(particles)) of_all += mass_of(size * diameter);
  return std::pow(mass * static_cast<double>(particles) / of_all, spheres() ? 1.0 / 3.0 : 1.0 / 2.0);
}

namespace {

/// Sizes come out as asked for, but for round-off of their number.
void check_sizes_found(const SlugModel& model) {
  constexpr double most = 0.01;
  const double off = std::abs(model.scale_of_sizes() - 1.0);
  if (off <= most) return;
  std::ostringstream text;
  text << "impactor.slug.size_distribution: " << model.particles
       << " particles are too few for it: all diameters would "
       << "have to be scaled by " << 100.0 * off << "% for the slug's mass, expected " << 100.0 * most
       << "% at most. Take smaller particles, a larger slug or a narrower distribution";
  throw InputError(text.str());
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
  if (symmetry == scene::SYMMETRY_AXISYMMETRIC) model.slice = slug.slice_angle();
  model.angle = slug.angle();
  model.offset = slug.offset();
  model.stand_off = slug.stand_off();
  model.tail_speed = slug.has_tail_speed() ? slug.tail_speed() : slug.speed();
  model.confined = slug.confined();
  model.diameter = particle.diameter();
  model.sizes = sizes_of(slug, symmetry);
  set_particles(particle, depth, model);
  check_sizes_found(model);

  const double kn = particle.normal_stiffness();
  model.pair_law = {kn, kn * particle.tangential_ratio(), 0.0, particle.friction(), false};
  model.surface_law = model.pair_law;
  model.surface_law.friction = contact.has_friction() ? contact.friction() : particle.friction();
  model.surface_law.tension_cutoff = contact.tension_cutoff();
  model.lever_is_radius = contact.lever_arm() == scene::SurfaceContact::LEVER_ARM_RADIUS;
  const double lightest = model.mass_of(model.smallest());
  model.pair = {kn, lightest / 2.0, particle.restitution(), false};
  model.on_surface = {kn, lightest, contact.has_restitution() ? contact.restitution() : particle.restitution(),
                      contact.tension_cutoff()};
  model.contact_time = contact_time(model.pair);
  model.stable_step = largest_stable_step(model.pair, model.pair_law.tangential_stiffness,
                                          model.spheres() ? neighbours_of_a_sphere : neighbours_of_a_disc);
  model.preferred_step = std::min(model.contact_time / 10.0, model.stable_step);
  return model;
}

double SlugModel::lightest_mass() const { return heaviest > 0.0 ? on_surface.effective_mass : mass_of(smallest()); }

double SlugModel::heaviest_mass() const { return heaviest > 0.0 ? heaviest : mass_of(largest()); }

void meet(SlugModel& model, const scene::SurfaceContact& contact, double free_mass, double facet) {
  model.free_mass = free_mass / model.whole();
  model.on_surface.effective_mass = contact::reduced_mass(model.lightest_mass(), model.free_mass);
  using Contact = scene::SurfaceContact;
  const bool fine = model.largest() > widest_point_contact * facet;
  model.chord =
      contact.spreading() == Contact::SPREADING_CHORD || (contact.spreading() != Contact::SPREADING_POINT && fine);
}

SlugModel slug_model_of(const wire::Setup& setup) {
  const wire::ImpactorSetup& part = setup.impactor();
  SlugModel model = make_slug_model(part.impactor(), setup.symmetry(), setup.depth(), setup.mirror());
  meet(model, part.impactor().slug().surface_contact(), part.free_mass(),
       mean_length(contact::MovingSurface(part.surface()).now()));
  return model;
}

namespace {

/// `heaviest`: kg, the largest effective mass.
ContactLaw calibrated(ContactLaw law, const SlugModel& model, const Collision& lightest, double heaviest, double dt) {
  if (model.sizes.equal()) {
    law.damping_rate = calibrated_damping(lightest, dt);
  } else {
    law.damping_table = std::make_shared<const contact::DampingTable>(damping_table(lightest, heaviest, dt));
  }
  return law;
}

}  // namespace

ContactLaw calibrated_pair_law(const SlugModel& model, double dt) {
  return calibrated(model.pair_law, model, model.pair, model.mass_of(model.largest()) / 2.0, dt);
}

ContactLaw calibrated_surface_law(const SlugModel& model, double dt) {
  const double heaviest = contact::reduced_mass(model.heaviest_mass(), model.free_mass);
  return calibrated(model.surface_law, model, model.on_surface, heaviest, dt);
}

double largest_stable_step(const Collision& pair, double tangential_stiffness, const Neighbours& neighbours) {
  const double mass = 2.0 * pair.effective_mass;
  const double stiffest = (neighbours.normal * pair.stiffness + neighbours.tangential * tangential_stiffness) / mass;
  const double half_rate = neighbours.damping * continuum_damping(pair);
  // Positive root of stiffest dt^2 + 2 half_rate dt = 4, in the form that does not cancel.
  return 4.0 / (half_rate + std::sqrt(half_rate * half_rate + 4.0 * stiffest));
}

}  // namespace grainstep::dem
