#include "contact_books.hpp"

#include <liggghts/atom.h>
#include <liggghts/fix.h>
#include <liggghts/neigh_list.h>
#include <liggghts/pair_gran.h>

#include <algorithm>
#include <base/assert.hpp>
#include <cmath>
#include <contact/particle_arrays.hpp>

using grainstep::contact::vector_of;
using grainstep::surface::cross;
using grainstep::surface::dot;
using grainstep::surface::norm;
using grainstep::surface::Vec3;

namespace {

constexpr int spring_values = 3;  // of LIGGGHTS's tangential model `history`, the first in its own history

bool touching(const LAMMPS_NS::Atom& atom, int i, int j) {
  const Vec3 branch = vector_of(atom.x[i]) - vector_of(atom.x[j]);
  const double reach = atom.radius[i] + atom.radius[j];
  return dot(branch, branch) < reach * reach;
}

bool any(const double* values) {
  return std::any_of(values, values + ContactBooks::values, [](double x) { return x != 0.0; });
}

}  // namespace

void ContactBooks::name_values(char** names_and_flags) {
  static char names[values][12] = {"dashpot_x", "dashpot_y", "dashpot_z", "drag_x",   "drag_y",
                                   "drag_z",    "turning_x", "turning_y", "turning_z"};
  static char turns[] = "1";
  static char stays[] = "0";  // both particles feel the same torque
  for (int h = 0; h < values; ++h) {
    names_and_flags[2 * h] = names[h];
    names_and_flags[2 * h + 1] = h < 6 ? turns : stays;
  }
}

void ContactBooks::add(LAMMPS_NS::PairGran& pair, LAMMPS_NS::Fix& owner, const LAMMPS_NS::Atom& atom, double grown) {
  GS_ASSERT(pair.dnum_pair() == spring_values, "LIGGGHTS keeps other values of a contact than a tangential spring");
  const LAMMPS_NS::NeighList& list = *pair.list;
  const int per_contact = pair.dnum();
  const int own = pair.fix_extra_dnum_index(&owner);
  energy_.stored_normal = energy_.stored_tangential = energy_.largest_overlap = 0.0;
  for (int k = 0; k < list.inum; ++k) {
    const int i = list.ilist[k];
    double* history = pair.listgranhistory->firstdouble[i];
    for (int n = 0; n < list.numneigh[i]; ++n, history += per_contact) {
      const int j = list.firstneigh[i][n] & NEIGHMASK;
      double* kept = history + own;
      const bool contact = touching(atom, i, j);
      if (!contact && !any(kept)) continue;
      const Last before{vector_of(kept), vector_of(kept + 3), vector_of(kept + 6)};
      Last now;
      if (contact) touch(atom, i, j, history, now);
      book(atom, i, j, before, now, grown);
      std::copy(now.dashpot.c.begin(), now.dashpot.c.end(), kept);
      std::copy(now.drag.c.begin(), now.drag.c.end(), kept + 3);
      std::copy(now.torque.c.begin(), now.torque.c.end(), kept + 6);
    }
  }
}

/// The parts of the force on `i` that LIGGGHTS has just computed, (2.1) and (2.2): its dashpot and its spring.
void ContactBooks::touch(const LAMMPS_NS::Atom& atom, int i, int j, const double* spring, Last& now) {
  const Vec3 branch = vector_of(atom.x[i]) - vector_of(atom.x[j]);
  const double length = norm(branch);
  const double reach = atom.radius[i] + atom.radius[j];
  const double overlap = reach - length;
  const Vec3 normal = branch * (1.0 / length);
  const double mass = atom.rmass[i] * atom.rmass[j] / (atom.rmass[i] + atom.rmass[j]);
  const double approach = dot(vector_of(atom.v[i]) - vector_of(atom.v[j]), normal);
  now.dashpot = -(mass * law_.damping_rate * approach) * normal;
  now.drag = -law_.tangential_stiffness * vector_of(spring);
  now.torque = -(atom.radius[i] - 0.5 * overlap) * cross(normal, now.drag);
  energy_.stored_normal += 0.5 * law_.normal_stiffness * overlap * overlap;
  energy_.stored_tangential += 0.5 * law_.tangential_stiffness * dot(vector_of(spring), vector_of(spring));
  energy_.largest_overlap = std::max(energy_.largest_overlap, overlap / reach);
}

void ContactBooks::book(const LAMMPS_NS::Atom& atom, int i, int j, const Last& before, const Last& now, double grown) {
  const Vec3 relative = vector_of(atom.v[i]) - vector_of(atom.v[j]);
  const Vec3 rolling = vector_of(atom.omega[i]) + vector_of(atom.omega[j]);
  const double half = 0.5 * grown;
  energy_.damping -= half * dot(before.dashpot + now.dashpot, relative);
  energy_.tangential -= half * (dot(before.drag + now.drag, relative) + dot(before.torque + now.torque, rolling));
}
