#include "dem-service/lammps/moment.hpp"

#include <stdexcept>
#include <string>

namespace grainstep::dem::lammps {
namespace {

using surface::Vec3;

/// LAMMPS keeps these to itself and those who derive from it.
class Lister : public LAMMPS_NS::Neighbor {
 public:
  static double** Neighbor::*positions() { return &Lister::xhold; }
};

std::vector<Vec3> copied(double** rows, int count) {
  std::vector<Vec3> out(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) std::copy_n(rows[i], 3, out[static_cast<std::size_t>(i)].c.begin());
  return out;
}

void put(const std::vector<Vec3>& values, double** rows) {
  for (std::size_t i = 0; i < values.size(); ++i) std::copy_n(values[i].c.begin(), 3, rows[i]);
}

void require_complete(const Moment& moment, int particles) {
  const auto count = static_cast<std::size_t>(particles);
  for (const std::size_t size : {moment.identity.size(), moment.radius.size(), moment.mass.size(),
                                 moment.listed_at.size(), moment.position.size(), moment.velocity.size(),
                                 moment.spin.size(), moment.force.size(), moment.torque.size()}) {
    if (size == count) continue;
    throw std::range_error("the state has " + std::to_string(size) + " particles, this slug " + std::to_string(count));
  }
}

}  // namespace

Moment moment_of(Instance& lammps) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  LAMMPS_NS::Neighbor& neighbor = *lammps.neighbor;
  const int count = atom.nlocal;
  return {.step = lammps.update->ntimestep,
          .next_sorting = atom.nextsort,
          .last_list = neighbor.lastcall,
          .identity = {atom.tag, atom.tag + count},
          .radius = {atom.radius, atom.radius + count},
          .mass = {atom.rmass, atom.rmass + count},
          .listed_at = copied(neighbor.*Lister::positions(), count),
          .position = copied(atom.x, count),
          .velocity = copied(atom.v, count),
          .spin = copied(atom.omega, count),
          .force = copied(atom.f, count),
          .torque = copied(atom.torque, count)};
}

void list_again(Instance& lammps, const Moment& moment) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  require_complete(moment, atom.nlocal);
  std::copy(moment.identity.begin(), moment.identity.end(), atom.tag);
  std::copy(moment.radius.begin(), moment.radius.end(), atom.radius);
  std::copy(moment.mass.begin(), moment.mass.end(), atom.rmass);
  put(moment.listed_at, atom.x);
  lammps.update->ntimestep = moment.last_list;
  // As a step of LAMMPS's does it (Verlet::run), but for sorting.
  lammps.domain->pbc();
  lammps.domain->reset_box();
  lammps.comm->setup();
  lammps.neighbor->setup_bins();
  lammps.comm->exchange();
  lammps.comm->borders();
  lammps.modify->pre_neighbor();
  lammps.neighbor->build(1);
  lammps.modify->post_neighbor();
}

void go_on_from(Instance& lammps, const Moment& moment) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  put(moment.position, atom.x);
  put(moment.velocity, atom.v);
  put(moment.spin, atom.omega);
  put(moment.force, atom.f);
  put(moment.torque, atom.torque);
  lammps.update->ntimestep = moment.step;
  // The line of its log with which a run begins wants energies and pressure of this step, or ends the run.
  lammps.update->eflag_global = lammps.update->vflag_global = moment.step;
  atom.nextsort = moment.next_sorting;
}

}  // namespace grainstep::dem::lammps
