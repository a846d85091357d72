/// @file What contacts between particles store and dissipate, read from LIGGGHTS: it has the overlaps, velocities and
/// tangential springs, and keeps numbers of ours with every contact. Nothing is computed that acts on a particle.
///
/// Work is booked as in Grainstep's own engine: velocity Verlet changes the kinetic energy by the mean of a step's old
/// and new forces times the velocity between them, so each contact's last forces are kept for one step.
#pragma once

#include <contact/contact_law.hpp>
#include <dem-service/law/pair_energy.hpp>

namespace LAMMPS_NS {
class Atom;
class Fix;
class PairGran;
}  // namespace LAMMPS_NS

class ContactBooks {
 public:
  /// Of a contact: dashpot force, tangential force and torque on its first particle.
  static constexpr int values = 9;
  /// LIGGGHTS's arguments for them: a name, and "1" where a value changes its sign with the order of the particles.
  static void name_values(char** names_and_flags);

  explicit ContactBooks(const grainstep::contact::ContactLaw& law) : law_(law) {}

  /// After LIGGGHTS has computed the contacts of a step, with the velocities it has used. `grown`: s since the last
  /// step. `owner`: the fix for which LIGGGHTS keeps the values. Particles have one size.
  void add(LAMMPS_NS::PairGran& pair, LAMMPS_NS::Fix& owner, const LAMMPS_NS::Atom& atom, double grown);

  [[nodiscard]] const grainstep::dem::PairEnergy& energy() const { return energy_; }

 private:
  struct Last {
    grainstep::surface::Vec3 dashpot, drag, torque;
  };
  void touch(const LAMMPS_NS::Atom& atom, int i, int j, const double* spring, Last& now);
  void book(const LAMMPS_NS::Atom& atom, int i, int j, const Last& before, const Last& now, double grown);

  grainstep::contact::ContactLaw law_;
  grainstep::dem::PairEnergy energy_;
};
