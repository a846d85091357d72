#include "dem-service/pair/style.hpp"

#include <lammps/atom.h>
#include <lammps/comm.h>
#include <lammps/domain.h>
#include <lammps/error.h>
#include <lammps/force.h>
#include <lammps/lammps.h>
#include <lammps/memory.h>
#include <lammps/modify.h>
#include <lammps/neigh_list.h>
#include <lammps/neighbor.h>
#include <lammps/update.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "base/assert.hpp"

namespace grainstep::dem {
namespace {

LAMMPS_NS::Pair* create_pair(LAMMPS_NS::LAMMPS* lammps) { return new PairStyle(lammps); }  // owned by LAMMPS

}  // namespace

PairStyle& PairStyle::find(LAMMPS_NS::LAMMPS& lammps) {
  auto* style = dynamic_cast<PairStyle*>(lammps.force->pair);
  GS_ASSERT(style != nullptr, "another pair style");
  return *style;
}

/// Makes the fix at once: its turn in pre_exchange is before that of fixes that move particles, such as balance.
PairStyle::PairStyle(LAMMPS_NS::LAMMPS* lammps) : Pair(lammps) {
  single_enable = 0;
  restartinfo = 0;
  no_virial_fdotr_compute = 1;
  finitecutflag = 1;
  modify->add_fix(std::string(PairFix::fix_id) + " all " + PairFix::style_name);
  auto* fix = dynamic_cast<PairFix*>(modify->fix[modify->find_fix(PairFix::fix_id)]);
  GS_ASSERT(fix != nullptr, "another style of fix");
  fix->connect(*this);
}

PairStyle::~PairStyle() {
  if (modify->nfix > 0) modify->delete_fix(PairFix::fix_id);
  if (allocated == 0) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairStyle::settings(int argument_count, char** arguments) {
  if (argument_count != 4 && argument_count != 6)
    error->all(FLERR, std::string("pair_style grainstep/hooke Kn Ks gamma_n mu"));
  double* const numbers[] = {&law_.normal_stiffness, &law_.tangential_stiffness, &law_.damping_rate, &law_.friction};
  for (int a = 0; a < 4; ++a) *numbers[a] = std::stod(arguments[a]);
  contacts_.reset();
  features_.dimension = domain->dimension;
  features_.friction = law_.friction > 0.0 && law_.tangential_stiffness > 0.0;
  features_.energy = argument_count < 6 || std::strcmp(arguments[5], "no") != 0;
}

void PairStyle::damp_by_mass(std::shared_ptr<const contact::DampingTable> table) {
  damping_table_ = std::move(table);
  law_.damping_table = damping_table_.get();
  features_.mixed = damping_table_ != nullptr;
  contacts_.reset();
}

void PairStyle::allocate() {
  const int types = atom->ntypes + 1;
  memory->create(setflag, types, types, "pair:setflag");
  memory->create(cutsq, types, types, "pair:cutsq");
  for (int i = 0; i < types; ++i) std::fill_n(setflag[i], types, 0);
  allocated = 1;
}

void PairStyle::coeff(int /*argument_count*/, char** /*arguments*/) {
  if (allocated == 0) allocate();
  for (int i = 1; i <= atom->ntypes; ++i) {
    for (int j = i; j <= atom->ntypes; ++j) setflag[i][j] = 1;
  }
}

void PairStyle::init_style() {
  if (atom->sphere_flag == 0) error->all(FLERR, std::string("pair_style grainstep/hooke needs atom_style sphere"));
  if (force->newton_pair == 0) error->all(FLERR, std::string("pair_style grainstep/hooke needs newton on"));
  if (comm->ghost_velocity == 0) error->all(FLERR, std::string("pair_style grainstep/hooke needs comm_modify vel yes"));
  neighbor->request(this, instance_me);
  if (!contacts_) contacts_.emplace(law_, features_);
  double mine = 0.0;
  for (int i = 0; i < atom->nlocal; ++i) mine = std::max(mine, atom->radius[i]);
  MPI_Allreduce(&mine, &largest_radius_, 1, MPI_DOUBLE, MPI_MAX, world);
}

double PairStyle::init_one(int /*i*/, int /*j*/) { return 2.0 * largest_radius_; }

void PairStyle::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const auto block = [&](double** rows) { return atom->nlocal + atom->nghost > 0 ? rows[0] : nullptr; };
  contacts_->evaluate({.position = block(atom->x),
                       .velocity = block(atom->v),
                       .spin = block(atom->omega),
                       .force = block(atom->f),
                       .torque = block(atom->torque),
                       .radius = atom->radius,
                       .mass = atom->rmass},
                      update->setupflag != 0 ? 0.0 : update->dt);
}

void PairStyle::to_particles(Partners& partners) const {
  partners.clear();
  const int values = contacts_->values_per_contact();
  for (std::size_t n = 0; n < contacts_->count(); ++n) {
    const auto [i, j] = contacts_->pair_of(n);
    Partners::Entry& first = partners.add(i, atom->tag[j]);
    for (int h = 0; h < values; ++h) first.value[h] = contacts_->value(n, h);
    Partners::Entry& second = partners.add(j, atom->tag[i]);
    for (int h = 0; h < values; ++h) second.value[h] = contacts_->seen_from_second(h) * contacts_->value(n, h);
  }
}

void PairStyle::from_particles(const Partners& partners) {
  contacts_->clear(largest_radius_);
  // LAMMPS's list reaches for all pairs as far as for two of the largest.
  const auto out_of_reach = [&](int i, int j) {
    double squared = 0.0;
    for (int c = 0; c < 3; ++c) squared += (atom->x[i][c] - atom->x[j][c]) * (atom->x[i][c] - atom->x[j][c]);
    const double reach = atom->radius[i] + atom->radius[j] + neighbor->skin;
    return squared > reach * reach;
  };
  for (int k = 0; k < list->inum; ++k) {
    const int i = list->ilist[k];
    const bool touched = partners.first_of(i) != Partners::none;
    const int* neighbours = list->firstneigh[i];
    for (int n = 0; n < list->numneigh[i]; ++n) {
      const int j = neighbours[n] & NEIGHMASK;
      if (features_.mixed && out_of_reach(i, j)) continue;
      contacts_->add(i, j);
      if (!touched) continue;
      if (const Partners::Entry* entry = partners.find(i, atom->tag[j])) contacts_->adopt(entry->value);
    }
  }
}

namespace {

LAMMPS_NS::Fix* create_fix(LAMMPS_NS::LAMMPS* lammps, int argument_count, char** arguments) {
  return new PairFix(lammps, argument_count, arguments);  // owned by LAMMPS's list of fixes
}

}  // namespace

void PairStyle::register_style(LAMMPS_NS::LAMMPS& lammps) {
  (*lammps.force->pair_map)[style_name] = &create_pair;
  (*lammps.modify->fix_map)[PairFix::style_name] = &create_fix;
}

PairFix::PairFix(LAMMPS_NS::LAMMPS* lammps, int argument_count, char** arguments)
    : Fix(lammps, argument_count, arguments) {
  create_attribute = 1;
  maxexchange_dynamic = 1;
  maxexchange = 1;
  PairFix::grow_arrays(atom->nmax);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
}

PairFix::~PairFix() { atom->delete_callback(id, LAMMPS_NS::Atom::GROW); }

int PairFix::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return PRE_EXCHANGE | POST_NEIGHBOR | POST_RUN;
}

void PairFix::pre_exchange() {
  style_->to_particles(partners_);
  // A ghost's contacts belong to its owner, who may be on another rank.
  if (comm->nprocs > 1) comm->reverse_comm_fix_variable(this);
  maxexchange = 1;
  for (int i = 0; i < atom->nlocal; ++i) maxexchange = std::max(maxexchange, packed_size(i));
}

void PairFix::post_neighbor() {
  style_->from_particles(partners_);
  partners_.clear();
}

int PairFix::pack_exchange(int i, double* buffer) {
  double* next = buffer;
  *next++ = partners_.count_of(i);
  for (auto e = partners_.first_of(i); e != Partners::none; e = partners_.entry(e).next) {
    const Partners::Entry& entry = partners_.entry(e);
    *next++ = entry.partner;
    next = std::copy_n(entry.value, values(), next);
  }
  return static_cast<int>(next - buffer);
}

int PairFix::unpack_exchange(int i, double* buffer) {
  partners_.clear(i);
  const auto count = static_cast<int>(buffer[0]);
  const double* next = buffer + 1;
  for (int n = 0; n < count; ++n) {
    Partners::Entry& entry = partners_.add(i, static_cast<std::int32_t>(*next++));
    std::copy_n(next, values(), entry.value);
    next += values();
  }
  return static_cast<int>(next - buffer);
}

int PairFix::pack_reverse_comm_size(int count, int first) {
  int size = 0;
  for (int i = first; i < first + count; ++i) size += packed_size(i);
  return size;
}

int PairFix::pack_reverse_comm(int count, int first, double* buffer) {
  int size = 0;
  for (int i = first; i < first + count; ++i) size += pack_exchange(i, buffer + size);
  return size;
}

void PairFix::unpack_reverse_comm(int count, int* list, double* buffer) {
  for (int n = 0; n < count; ++n) {
    const auto partners = static_cast<int>(*buffer++);
    for (int p = 0; p < partners; ++p) {
      Partners::Entry& entry = partners_.add(list[n], static_cast<std::int32_t>(*buffer++));
      std::copy_n(buffer, values(), entry.value);
      buffer += values();
    }
  }
}

}  // namespace grainstep::dem
