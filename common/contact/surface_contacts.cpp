#include "contact/surface_contacts.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace grainstep::contact {
namespace {

using surface::ClosestPoint;
using surface::Vec2;
using surface::Vec3;

constexpr double round_off = 1e-13;  // of a radius: springs shorter than that carry nothing

std::string tunnelled(const SurfaceContactSettings& settings, const ParticleArrays& particles, int i,
                      const ClosestPoint& at) {
  const double* x = particles.position[i];
  std::ostringstream text;
  text << settings.name << " " << particles.identity[i]
       << " passed through the surface (tunnelled) at x1 = " << place_of(settings.shape, x)[0] << " m, x2 = " << x[1]
       << " m: its centre lies " << -at.distance << " m inside, more than its diameter " << 2.0 * particles.radius[i]
       << " m; " << settings.remedy;
  return text.str();
}

ContactLaw law_of(const ContactLaw& law, const ParticleArrays& particles, int i) {
  if (particles.share == nullptr) return law;
  ContactLaw own = law;
  own.normal_stiffness *= particles.share[i];
  own.tangential_stiffness *= particles.share[i];
  return own;
}

void add_ring(const Meridian& plane, const Vec3& force, const Vec3& velocity, ParticleSide& side) {
  const double across = plane.across(force);
  side.radial += plane.in_plane(force)[0];
  side.size += norm(force);
  side.around += std::abs(across);
  side.around_power += across * plane.across(velocity);
}

}  // namespace

SurfaceContacts::SurfaceContacts(const SurfaceContactSettings& settings) : settings_(settings) {}

void SurfaceContacts::rebuild(const ParticleArrays& particles, MovingSurface& surface) {
  // Outside, contact begins at one radius. Inside, the centre is followed to one diameter and the radius that it may
  // move in one step: whoever passes through is seen.
  const double reach = 3.0 * settings_.largest_radius + settings_.particle_margin + settings_.surface_margin;
  surface.remember();
  grid_.rebuild(surface.now(), reach);
  candidates_.clear();
  near_.clear();
  for (int i = 0; i < particles.owned; ++i) {
    const Vec2 p = place_of(settings_.shape, particles.position[i]);
    if (!grid_.covers(p)) continue;
    const auto first = static_cast<std::uint32_t>(near_.size());
    grid_.near(surface.now(), p, near_);
    const auto last = static_cast<std::uint32_t>(near_.size());
    if (last > first) candidates_.push_back({i, first, last, 0.0});
  }
}

std::optional<std::string> SurfaceContacts::evaluate(const ParticleArrays& particles, const MovingSurface& surface,
                                                     double dt, double weight, std::vector<Vec2>& nodal) {
  std::optional<std::string> failure;
  contacts_.clear();
  footing_.clear();
  stored_normal_ = stored_tangential_ = 0.0;
  for (Candidate& candidate : candidates_) {
    const int i = candidate.particle;
    const double* v = particles.velocity[i];
    candidate.clear -= (std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]) + surface.fastest()) * dt;
    if (candidate.clear > 0.0) continue;
    const std::span<const std::uint32_t> segments(near_.data() + candidate.first, candidate.last - candidate.first);
    const Vec2 centre = place_of(settings_.shape, particles.position[i]);
    const ClosestPoint at = surface.now().closest(centre, segments);
    if (at.distance < particles.radius[i]) {
      if (at.distance < -2.0 * particles.radius[i] && !failure) failure = tunnelled(settings_, particles, i, at);
      const Foot foot = settings_.chord ? footing_.over_chord(surface, centre, particles.radius[i], segments, at)
                                        : Footing::at_point(at);
      touch(particles, surface, i, foot, dt);
      const Contact& contact = contacts_.back();
      footing_.give(surface, foot, -(settings_.whole * weight) * contact.plane.in_plane(contact.total), nodal);
      candidate.clear = 0.0;
    } else {
      particles.spring[i] = {};
      // A distance shrinks no faster than the two come together; a thousandth is left for round-off.
      candidate.clear = 0.999 * (at.distance - particles.radius[i]);
    }
  }
  return failure;
}

void SurfaceContacts::touch(const ParticleArrays& particles, const MovingSurface& surface, int i, const Foot& foot,
                            double dt) {
  const ClosestPoint& at = foot.at;
  const ContactLaw law = law_of(settings_.law, particles, i);
  const double radius = particles.radius[i];
  const double overlap = radius - at.distance;
  const Meridian plane = meridian_of(settings_.shape, particles.position[i]);
  const Vec3 normal = plane.in_space(at.normal);
  const Branch branch = branch_along(normal, at.distance, radius);
  const Vec3 relative = vector_of(particles.velocity[i]) - plane.in_space(footing_.velocity(surface, foot));
  const double mass = reduced_mass(particles.mass[i], settings_.free_mass);
  const NormalForce push = normal_force(law, branch, overlap, relative, mass, foot.gain);

  Vec3 drag;
  Vec3 torque;
  if (law.friction > 0.0 && law.tangential_stiffness > 0.0) {
    const double lever = settings_.lever_is_radius ? radius : foot.is_point() ? branch.length : foot.lever;
    Vec3 spring = turned_into_tangent_plane(particles.spring[i], normal, round_off * radius);
    spring += slip_rate(branch, relative, lever, vector_of(particles.spin[i])) * dt;
    spring -= dot(spring, branch.vector) * branch.per_squared * branch.vector;
    drag = tangential_force(law, push.total() * branch.length, spring);
    torque = -(lever * (branch.per_length * cross(branch.vector, drag)));
    particles.spring[i] = spring;
    stored_tangential_ += 0.5 * law.tangential_stiffness * dot(spring, spring);
  }
  stored_normal_ += 0.5 * law.normal_stiffness * overlap * overlap;
  largest_overlap_ = std::max(largest_overlap_, overlap / (2.0 * radius));
  const Vec3 total = push.total() * branch.vector + drag;
  contacts_.push_back({i, foot, plane, push.dashpot * branch.vector, drag, total, torque});
}

void SurfaceContacts::apply(const ParticleArrays& particles) const {
  for (const Contact& contact : contacts_) {
    add_to(particles.force[contact.particle], contact.total);
    add_to(particles.torque[contact.particle], contact.torque);
  }
}

SurfaceSide SurfaceContacts::surface_side(const MovingSurface& surface) const {
  SurfaceSide side;
  for (const Contact& contact : contacts_) {
    const Vec3 velocity = contact.plane.in_space(footing_.velocity(surface, contact.foot));
    side.power += dot(contact.total, velocity);
    side.dashpot += dot(contact.dashpot, velocity);
    side.tangential += dot(contact.tangential, velocity);
  }
  return side;
}

void SurfaceContacts::begin_interval(const MovingSurface& surface, double dt) {
  ledger_.add(dt / 2.0, particle_side_, surface_side(surface));
}

void SurfaceContacts::end_interval(const ParticleArrays& particles, const MovingSurface& surface, double dt) {
  ParticleSide side;
  for (const Contact& contact : contacts_) {
    const Vec3 velocity = vector_of(particles.velocity[contact.particle]);
    const double turning = dot(contact.torque, vector_of(particles.spin[contact.particle]));
    side.force += contact.total;
    side.power += dot(contact.total, velocity) + turning;
    side.dashpot += dot(contact.dashpot, velocity);
    side.tangential += dot(contact.tangential, velocity) + turning;
    if (settings_.shape == Shape::revolved) add_ring(contact.plane, contact.total, velocity, side);
  }
  particle_side_ = side;
  ledger_.add(dt / 2.0, particle_side_, surface_side(surface));
}

}  // namespace grainstep::contact
