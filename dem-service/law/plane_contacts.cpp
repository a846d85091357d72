#include "dem-service/law/plane_contacts.hpp"

#include <algorithm>

namespace grainstep::dem {

using contact::Branch;
using contact::branch_along;
using contact::NormalForce;
using contact::vector_of;

void PlaneContacts::rebuild(const ParticleArrays& particles) {
  candidates_.clear();
  for (int i = 0; i < particles.owned; ++i) {
    if (distance(particles, i) < particles.radius[i] + margin_) candidates_.push_back(i);
  }
}

void PlaneContacts::evaluate(const ParticleArrays& particles) {
  // Distances, velocities and overlaps to the image are twice those to the plane; mass and energy are shared with it.
  const double times = plane_.kind == Plane::Kind::mirror ? 2.0 : 1.0;
  contacts_.clear();
  stored_ = 0.0;
  for (const int i : candidates_) {
    const double radius = particles.radius[i];
    const double gap = distance(particles, i);
    const double overlap = times * (radius - gap);
    if (overlap <= 0.0) continue;
    const Branch branch = branch_along(plane_.inward, times * gap, radius);
    const Vec3 relative = times * vector_of(particles.velocity[i]);
    const NormalForce push = normal_force(law_, branch, overlap, relative, particles.mass[i] / times);
    stored_ += 0.5 * law_.normal_stiffness * overlap * overlap / times;
    largest_overlap_ = std::max(largest_overlap_, overlap / (2.0 * radius));
    contacts_.push_back({i, push.total() * branch.vector, push.dashpot * branch.vector});
  }
}

void PlaneContacts::apply(const ParticleArrays& particles) const {
  for (const Contact& one : contacts_) contact::add_to(particles.force[one.particle], one.total);
}

void PlaneContacts::end_interval(const ParticleArrays& particles, double dt) {
  ParticleSide side;
  for (const Contact& contact : contacts_) {
    const Vec3 velocity = vector_of(particles.velocity[contact.particle]);
    side.force += contact.total;
    side.power += dot(contact.total, velocity);
    side.dashpot += dot(contact.dashpot, velocity);
  }
  particle_side_ = side;
  ledger_.add(dt / 2.0, particle_side_, {});
}

}  // namespace grainstep::dem
