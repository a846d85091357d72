/// @file MPI for a program that may be started by mpirun or by itself.
#pragma once

#include <mpi.h>

#include <cstdlib>

namespace grainstep::dem {

/// Whether this process was started by itself, not by mpirun.
[[nodiscard]] inline bool is_alone() { return std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr; }

/// Initialises MPI unless that was done. A process started alone needs no daemon beside it (Open MPI would look for
/// `orted`, which slim images lack), no session directory: several that start and end at once remove each other's, and
/// no network: Open MPI would open all that it knows to choose the fastest, for 0.2 s. Nobody needs to know its
/// displays. A rank that waits for the other side gives its core to whoever can use it.
inline void start_mpi() {
  int initialised = 0;
  MPI_Initialized(&initialised);
  if (initialised != 0) return;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("HWLOC_COMPONENTS", "-gl", 0);
  if (is_alone()) {
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    setenv("OMPI_MCA_pml", "ob1", 0);
  }
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  MPI_Init(nullptr, nullptr);
}

/// Where it was started.
inline void end_mpi() {
  int initialised = 0;
  MPI_Initialized(&initialised);
  if (initialised != 0) MPI_Finalize();
}

}  // namespace grainstep::dem
