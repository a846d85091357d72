/// @file The engine's own LAMMPS pair style, and the fix that carries its history while LAMMPS reorders particles and
/// moves them between ranks.
///
///     pair_style grainstep/hooke Kn Ks gamma_n mu [energy yes|no]
///     pair_coeff * *
///
/// Where particles differ in mass, damp_by_mass() replaces gamma_n between these commands and the run.
///
/// The law of `gran/hooke/history Kn Ks gamma_n 0 mu 0`, bit for bit (tests/verification/dem_pair_style_test.cpp).
/// Needs atom_style sphere, newton on and `comm_modify vel yes`; knows no frozen or rigid particles and no pressure.
/// docs/decisions/0009-own-pair-style.md says why.
#pragma once

#include <memory>
#include <optional>

#include "dem-service/lammps/adapter.hpp"
#include "dem-service/pair/contacts.hpp"
#include "dem-service/pair/partners.hpp"

namespace grainstep::dem {

class PairFix;

class PairStyle : public lammps::UniformPair {
 public:
  static constexpr const char* style_name = "grainstep/hooke";

  /// Makes pair style and fix known to this LAMMPS instance.
  static void register_style(lammps::Instance& lammps);

  /// gamma_n for every effective mass, instead of the one of the command. nullptr: the command's.
  void damp_by_mass(std::shared_ptr<const contact::DampingTable> table);

  explicit PairStyle(lammps::Instance* lammps);
  ~PairStyle() override;
  PairStyle(const PairStyle&) = delete;
  PairStyle& operator=(const PairStyle&) = delete;
  PairStyle(PairStyle&&) = delete;
  PairStyle& operator=(PairStyle&&) = delete;

  void settings(int argument_count, char** arguments) override;
  void init_style() override;
  double init_one(int i, int j) override;
  void compute(int eflag, int vflag) override;

  /// This rank's share.
  [[nodiscard]] const PairEnergy& energy() const { return contacts_->energy(); }
  /// This rank's, for a state that is saved or read.
  [[nodiscard]] PairContacts& contacts() { return *contacts_; }

 private:
  friend class PairFix;
  /// Between lists of pairs, particles carry their contacts themselves.
  void to_particles(Partners& partners) const;
  void from_particles(const Partners& partners);

  PairLaw law_;
  PairFeatures features_;
  std::shared_ptr<const contact::DampingTable> damping_table_;
  std::optional<PairContacts> contacts_;
  double largest_radius_ = 0.0;
};

class PairFix : public lammps::ParticleFix {
 public:
  static constexpr const char* style_name = "grainstep/pair";
  static constexpr const char* fix_id = "grainstep_pair";

  PairFix(lammps::Instance* lammps, int argument_count, char** arguments);

  void connect(PairStyle& pair_style) { style_ = &pair_style; }
  /// The contacts that particles carry from one list of pairs to the next.
  void forget() { partners_.clear(); }

  int setmask() override;
  void setup_post_neighbor() override { post_neighbor(); }
  void pre_exchange() override;
  void post_neighbor() override;
  /// Particles may be changed between two runs.
  void post_run() override { pre_exchange(); }

  void grow_arrays(int capacity) override { partners_.grow(capacity); }
  void copy_arrays(int from, int to, int /*delete_flag*/) override { partners_.move(from, to); }
  void set_arrays(int i) override { partners_.clear(i); }
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  int pack_reverse_comm_size(int count, int first) override;
  int pack_reverse_comm(int count, int first, double* buffer) override;
  void unpack_reverse_comm(int count, int* list, double* buffer) override;

 private:
  [[nodiscard]] int values() const { return style_->contacts_->values_per_contact(); }
  [[nodiscard]] int packed_size(int i) const { return 1 + partners_.count_of(i) * (1 + values()); }

  PairStyle* style_ = nullptr;
  Partners partners_;
};

}  // namespace grainstep::dem
