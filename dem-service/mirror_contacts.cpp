#include "dem-service/mirror_contacts.hpp"

#include <algorithm>

namespace grainstep::dem {

void MirrorContacts::rebuild(const ParticleArrays& particles) {
  candidates_.clear();
  for (int i = 0; i < particles.owned; ++i) {
    if (particles.position[i][0] < particles.radius[i] + margin_) candidates_.push_back(i);
  }
}

void MirrorContacts::evaluate(const ParticleArrays& particles) {
  contacts_.clear();
  stored_ = 0.0;
  for (const int i : candidates_) {
    const double radius = particles.radius[i];
    const double overlap = 2.0 * (radius - particles.position[i][0]);
    if (overlap <= 0.0) continue;
    const Branch branch = branch_along({{1.0, 0.0, 0.0}}, 2.0 * particles.position[i][0], radius);
    const Vec3 relative{{2.0 * particles.velocity[i][0], 0.0, 0.0}};
    const NormalForce push = normal_force(law_, branch, overlap, relative, particles.mass[i] / 2.0);
    stored_ += 0.5 * (0.5 * law_.normal_stiffness * overlap * overlap);
    largest_overlap_ = std::max(largest_overlap_, overlap / (2.0 * radius));
    contacts_.push_back({i, push.total() * branch.length, push.dashpot * branch.length});
  }
}

void MirrorContacts::apply(const ParticleArrays& particles) const {
  for (const Contact& contact : contacts_) particles.force[contact.particle][0] += contact.total;
}

void MirrorContacts::end_interval(const ParticleArrays& particles, double dt) {
  ParticleSide side;
  for (const Contact& contact : contacts_) {
    const double velocity = particles.velocity[contact.particle][0];
    side.force[0] += contact.total;
    side.power += contact.total * velocity;
    side.dashpot += contact.dashpot * velocity;
  }
  particle_side_ = side;
  ledger_.add(dt / 2.0, particle_side_, {});
}

}  // namespace grainstep::dem
