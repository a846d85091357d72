/// @file What a script has made, read from LAMMPS.
#pragma once

#include <mpi.h>

#include "dem-service/deck/deck_model.hpp"
#include "dem-service/lammps/adapter.hpp"

namespace grainstep::dem {

/// Collective. InputError for a script in other units than SI.
[[nodiscard]] DeckParticles deck_particles(lammps::Instance& instance, MPI_Comm communicator);

}  // namespace grainstep::dem
