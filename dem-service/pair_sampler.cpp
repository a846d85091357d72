#include "dem-service/pair_sampler.hpp"

#include <lammps/atom.h>
#include <lammps/neigh_list.h>

#include <algorithm>
#include <cmath>

namespace grainstep::dem {

using surface::Vec3;

void PairSampler::synchronise(const LAMMPS_NS::Atom& atom) {
  values_.resize(static_cast<std::size_t>(values_per_particle * (atom.nlocal + atom.nghost)));
  for (int i = 0; i < atom.nlocal; ++i) {
    const double per_mass = 0.5 * law_.dt / atom.rmass[i];
    const double per_inertia = per_mass / (0.5 * atom.radius[i] * atom.radius[i]);  // cylinder: m R^2/2
    double* value = values(i);
    for (int c = 0; c < 3; ++c) {
      value[c] = atom.v[i][c] + per_mass * atom.f[i][c];
      value[3 + c] = atom.omega[i][c] + per_inertia * atom.torque[i][c];
    }
  }
}

PairSample PairSampler::sweep(LAMMPS_NS::Pair& pair, const LAMMPS_NS::Atom& atom, const SweepPart& part) {
  PairSample sample;
  const LAMMPS_NS::NeighList& list = *pair.list;
  const double* positions = atom.nlocal > 0 ? atom.x[0] : nullptr;  // LAMMPS keeps them in one block
  const double nearly = law_.largest_diameter * law_.largest_diameter;
  for (int k = part.offset; k < list.inum; k += part.stride) {
    const int i = list.ilist[k];
    const double* x = positions + 3 * static_cast<std::ptrdiff_t>(i);
    const int* neighbours = list.firstneigh[i];
    const int count = list.numneigh[i];
    for (int n = 0; n < count; ++n) {
      const int j = neighbours[n] & NEIGHMASK;
      const double* y = positions + 3 * static_cast<std::ptrdiff_t>(j);
      const Vec3 apart{{x[0] - y[0], x[1] - y[1], x[2] - y[2]}};
      const double squared = dot(apart, apart);
      if (squared >= nearly) continue;
      const double reach = atom.radius[i] + atom.radius[j];
      if (squared < reach * reach) touch(pair, atom, i, j, apart, squared, sample);
    }
  }
  sample.stored_normal *= part.stride;
  sample.stored_tangential *= part.stride;
  sample.dashpot_power *= part.stride;
  sample.tangential_power *= part.stride;
  return sample;
}

void PairSampler::touch(LAMMPS_NS::Pair& pair, const LAMMPS_NS::Atom& atom, int i, int j, const Vec3& apart,
                        double squared, PairSample& sample) {
  const double distance = std::sqrt(squared);
  const double reach = atom.radius[i] + atom.radius[j];
  const double overlap = reach - distance;
  // single() returns the normal force over the distance, and the tangential force on i in its extra values.
  double normal_over_distance = 0.0;
  pair.single(i, j, atom.type[i], atom.type[j], squared, 1.0, 1.0, normal_over_distance);
  const double dashpot_over_distance = normal_over_distance - law_.normal_stiffness * overlap / distance;
  const double* of_i = values(i);
  const double* of_j = values(j);
  const Vec3 relative = vector_of(of_i) - vector_of(of_j);
  sample.dashpot_power -= dashpot_over_distance * dot(apart, relative);
  sample.stored_normal += 0.5 * law_.normal_stiffness * overlap * overlap;
  sample.largest_overlap = std::max(sample.largest_overlap, overlap / reach);
  if (law_.tangential_stiffness <= 0.0) return;
  // Torques are -radius (n x Ft) on both, so that slip is the velocity at the surfaces of two undeformed discs.
  const Vec3 drag = vector_of(pair.svector);
  const Vec3 turning = atom.radius[i] * vector_of(of_i + 3) + atom.radius[j] * vector_of(of_j + 3);
  sample.tangential_power -= dot(drag, relative) - dot(cross(apart, drag), turning) / distance;
  sample.stored_tangential += 0.5 * dot(drag, drag) / law_.tangential_stiffness;
}

}  // namespace grainstep::dem
