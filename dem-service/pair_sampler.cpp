#include "dem-service/pair_sampler.hpp"

#include <lammps/atom.h>
#include <lammps/neigh_list.h>

#include <algorithm>
#include <cmath>

namespace grainstep::dem {

using surface::Vec3;

void PairSampler::sweep(LAMMPS_NS::Pair& pair, const LAMMPS_NS::Atom& atom) {
  values_.assign(static_cast<std::size_t>(values_per_particle * (atom.nlocal + atom.nghost)), 0.0);
  sample_ = {};
  const LAMMPS_NS::NeighList& list = *pair.list;
  for (int k = 0; k < list.inum; ++k) {
    const int i = list.ilist[k];
    const double* x = atom.x[i];
    const double radius = atom.radius[i];
    const int* neighbours = list.firstneigh[i];
    for (int n = 0; n < list.numneigh[i]; ++n) {
      const int j = neighbours[n] & NEIGHMASK;
      const double* y = atom.x[j];
      const Vec3 apart{{x[0] - y[0], x[1] - y[1], x[2] - y[2]}};
      const double squared = dot(apart, apart);
      const double reach = radius + atom.radius[j];
      if (squared < reach * reach) touch(pair, atom, i, j, apart, squared);
    }
  }
}

void PairSampler::touch(LAMMPS_NS::Pair& pair, const LAMMPS_NS::Atom& atom, int i, int j, const Vec3& apart,
                        double squared) {
  const double distance = std::sqrt(squared);
  const double reach = atom.radius[i] + atom.radius[j];
  const double overlap = reach - distance;
  // single() returns the normal force over the distance, and the tangential force on i in its extra values.
  double normal_over_distance = 0.0;
  pair.single(i, j, atom.type[i], atom.type[j], squared, 1.0, 1.0, normal_over_distance);
  const Vec3 tangential = vector_of(pair.svector);
  const Vec3 dashpot = apart * (normal_over_distance - stiffness_.normal * overlap / distance);
  const Vec3 turning = cross(apart, tangential) * (1.0 / distance);
  double* of_i = values(i);
  double* of_j = values(j);
  for (std::size_t c = 0; c < 3; ++c) {
    of_i[c] += dashpot[c];
    of_j[c] -= dashpot[c];
    of_i[3 + c] += tangential[c];
    of_j[3 + c] -= tangential[c];
    of_i[6 + c] -= atom.radius[i] * turning[c];
    of_j[6 + c] -= atom.radius[j] * turning[c];
  }
  sample_.stored_normal += 0.5 * stiffness_.normal * overlap * overlap;
  if (stiffness_.tangential > 0.0) {
    sample_.stored_tangential += 0.5 * dot(tangential, tangential) / stiffness_.tangential;
  }
  sample_.largest_overlap = std::max(sample_.largest_overlap, overlap / reach);
}

PairSample PairSampler::finish(const ParticleArrays& particles) {
  for (int i = 0; i < particles.owned; ++i) {
    const double* value = values(i);
    const Vec3 velocity = vector_of(particles.velocity[i]);
    sample_.dashpot_power -= dot(vector_of(value), velocity);
    sample_.tangential_power -=
        dot(vector_of(value + 3), velocity) + dot(vector_of(value + 6), vector_of(particles.spin[i]));
  }
  return sample_;
}

}  // namespace grainstep::dem
