#include "dem-service/deck/deck_particles.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "dem-service/lammps/pair_style.hpp"

namespace grainstep::dem {
namespace {

double over_all(double mine, MPI_Op operation, MPI_Comm communicator) {
  double all = 0.0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, operation, communicator);
  return all;
}

}  // namespace

DeckParticles deck_particles(lammps::Instance& instance, MPI_Comm communicator) {
  constexpr double huge = std::numeric_limits<double>::max();
  const lammps::Particles mine = lammps::particles_of(instance);
  double smallest = huge, lightest = huge, largest = 0.0, heaviest = 0.0, mass = 0.0;
  for (int i = 0; mine.radius != nullptr && mine.mass != nullptr && i < mine.owned; ++i) {
    smallest = std::min(smallest, 2.0 * mine.radius[i]);
    largest = std::max(largest, 2.0 * mine.radius[i]);
    lightest = std::min(lightest, mine.mass[i]);
    heaviest = std::max(heaviest, mine.mass[i]);
    mass += mine.mass[i];
  }
  const lammps::Facts facts = lammps::facts_of(instance);
  DeckParticles out;
  out.count = static_cast<std::uint64_t>(over_all(mine.owned, MPI_SUM, communicator));
  out.smallest = over_all(smallest, MPI_MIN, communicator);
  out.largest = over_all(largest, MPI_MAX, communicator);
  out.lightest = over_all(lightest, MPI_MIN, communicator);
  out.heaviest = over_all(heaviest, MPI_MAX, communicator);
  out.mass = over_all(mass, MPI_SUM, communicator);
  if (out.smallest == huge) out.smallest = 0.0;
  out.step = facts.step;
  out.dimension = facts.dimension;
  out.own_pair_style = facts.pair_style == PairStyle::style_name;
  if (facts.units != "si") {
    throw InputError("impactor.deck: the script has units " + facts.units + "; write `units si`");
  }
  return out;
}

}  // namespace grainstep::dem
