#include "dem-service/lammps/pair_style.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

namespace grainstep::dem {

void PairStyle::register_style(lammps::Instance& lammps) {
  lammps::register_pair<PairStyle>(lammps);
  lammps::register_fix<PairFix>(lammps);
}

/// Makes the fix at once: its turn in pre_exchange is before that of fixes that move particles, such as balance.
PairStyle::PairStyle(lammps::Instance* lammps) : UniformPair(lammps) {
  add_fix(std::string(PairFix::fix_id) + " all " + PairFix::style_name);
  fix<PairFix>(PairFix::fix_id).connect(*this);
}

PairStyle::~PairStyle() { remove_fix(PairFix::fix_id); }

void PairStyle::settings(int argument_count, char** arguments) {
  if (argument_count != 4 && argument_count != 6) refuse("pair_style grainstep/hooke Kn Ks gamma_n mu");
  double* const numbers[] = {&law_.normal_stiffness, &law_.tangential_stiffness, &law_.damping_rate, &law_.friction};
  for (int a = 0; a < 4; ++a) *numbers[a] = std::stod(arguments[a]);
  contacts_.reset();
  features_.dimension = dimension();
  features_.friction = law_.friction > 0.0 && law_.tangential_stiffness > 0.0;
  features_.energy = argument_count < 6 || std::strcmp(arguments[5], "no") != 0;
}

void PairStyle::damp_by_mass(std::shared_ptr<const contact::DampingTable> table) {
  damping_table_ = std::move(table);
  law_.damping_table = damping_table_.get();
  features_.mixed = damping_table_ != nullptr;
  contacts_.reset();
}

void PairStyle::init_style() {
  require_spheres_with_spin("pair_style grainstep/hooke");
  request_list();
  if (!contacts_) contacts_.emplace(law_, features_);
  const lammps::Particles now = particles();
  double mine = 0.0;
  for (int i = 0; i < now.owned; ++i) mine = std::max(mine, now.radius[i]);
  largest_radius_ = largest_of_all_ranks(mine);
}

double PairStyle::init_one(int /*i*/, int /*j*/) { return 2.0 * largest_radius_; }

void PairStyle::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const lammps::Particles now = particles();
  contacts_->evaluate({.position = now.block(now.position),
                       .velocity = now.block(now.velocity),
                       .spin = now.block(now.spin),
                       .force = now.block(now.force),
                       .torque = now.block(now.torque),
                       .radius = now.radius,
                       .mass = now.mass},
                      grown());
}

void PairStyle::to_particles(Partners& partners) const {
  partners.clear();
  const auto* identity = particles().identity;
  const int values = contacts_->values_per_contact();
  for (std::size_t n = 0; n < contacts_->count(); ++n) {
    const auto [i, j] = contacts_->pair_of(n);
    Partners::Entry& first = partners.add(i, identity[j]);
    for (int h = 0; h < values; ++h) first.value[h] = contacts_->value(n, h);
    Partners::Entry& second = partners.add(j, identity[i]);
    for (int h = 0; h < values; ++h) second.value[h] = contacts_->seen_from_second(h) * contacts_->value(n, h);
  }
}

void PairStyle::from_particles(const Partners& partners) {
  contacts_->clear(largest_radius_);
  const lammps::Particles now = particles();
  const double beyond = skin();
  // LAMMPS's list reaches for all pairs as far as for two of the largest.
  const auto out_of_reach = [&](int i, int j) {
    double squared = 0.0;
    for (int c = 0; c < 3; ++c) {
      squared += (now.position[i][c] - now.position[j][c]) * (now.position[i][c] - now.position[j][c]);
    }
    const double reach = now.radius[i] + now.radius[j] + beyond;
    return squared > reach * reach;
  };
  bool touched = false;
  for_each_pair([&](int i) { touched = partners.first_of(i) != Partners::none; },
                [&](int i, int j) {
                  if (features_.mixed && out_of_reach(i, j)) return;
                  contacts_->add(i, j);
                  if (!touched) return;
                  const Partners::Entry* entry = partners.find(i, now.identity[j]);
                  if (entry != nullptr) contacts_->adopt(entry->value);
                });
}

PairFix::PairFix(lammps::Instance* lammps, int argument_count, char** arguments)
    : ParticleFix(lammps, argument_count, arguments) {
  maxexchange_dynamic = 1;
  maxexchange = 1;
  PairFix::grow_arrays(capacity());
  follow_particles();
}

int PairFix::setmask() {
  using namespace lammps::turns;
  return PRE_EXCHANGE | POST_NEIGHBOR | POST_RUN;
}

void PairFix::pre_exchange() {
  style_->to_particles(partners_);
  return_from_ghosts();  // a ghost's contacts belong to its owner, who may be on another rank
  maxexchange = 1;
  for (int i = 0, owned = particles().owned; i < owned; ++i) maxexchange = std::max(maxexchange, packed_size(i));
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
