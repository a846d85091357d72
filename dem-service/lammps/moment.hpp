/// @file All that decides a bit of what LAMMPS will do next, of a run in one process: its particles in its own order,
/// and where they were when it last listed neighbours. It lists them where they were and then puts them where they are,
/// so that sums are taken in the same order and lists are made anew in the same steps.
#pragma once

#include <cstdint>
#include <vector>

#include "dem-service/lammps/adapter.hpp"
#include "surface/vec.hpp"

namespace grainstep::dem::lammps {

struct Moment {
  std::int64_t step = 0;
  std::int64_t next_sorting = 0;  ///< step
  std::int64_t last_list = 0;     ///< step
  // In LAMMPS's order.
  std::vector<LAMMPS_NS::tagint> identity;
  std::vector<double> radius, mass;                     ///< m, kg
  std::vector<surface::Vec3> listed_at;                 ///< m, positions when neighbours were last listed
  std::vector<surface::Vec3> position, velocity, spin;  ///< m, m/s, 1/s
  std::vector<surface::Vec3> force, torque;             ///< N, N m

  template <class Archive>
  void serialize(Archive& archive) {
    archive("step", step);
    archive("next sorting", next_sorting);
    archive("last list", last_list);
    archive("identities", identity);
    archive("radii", radius);
    archive("masses", mass);
    archive("listed at", listed_at);
    archive("positions", position);
    archive("velocities", velocity);
    archive("spins", spin);
    archive("forces", force);
    archive("torques", torque);
  }
};

[[nodiscard]] Moment moment_of(Instance& lammps);

/// Takes all particles back to where they were when neighbours were last listed, in their order of then, and lists them
/// again: fixes and pair style are told as at any other time. Between two runs; std::range_error where the moment is of
/// another number of particles.
void list_again(Instance& lammps, const Moment& moment);

/// Puts them where they are, as fast as they are. A run without a preparation of its own (`run N pre no`) goes on.
void go_on_from(Instance& lammps, const Moment& moment);

}  // namespace grainstep::dem::lammps
