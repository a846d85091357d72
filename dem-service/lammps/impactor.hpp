/// @file The particle impactor: a slug of discs or spheres computed by LAMMPS, as a backend for
/// participant::serve_impactor.
#pragma once

#include <mpi.h>

#include <memory>
#include <string>

#include "participant/backend.hpp"

namespace grainstep::dem {

struct EngineOptions {
  MPI_Comm communicator = MPI_COMM_NULL;  ///< null: this process alone; MPI is initialised where it is not yet
  std::string lammps_log;                 ///< file for LAMMPS's own log; empty: none
  bool allow_deck = false;                ///< scripts may be run, which can do anything on this machine
};

/// For rank 0 of the communicator. The other ranks must be in follow() while this object lives.
/// Its Reports carry the observables listed in dem-service/README.md.
[[nodiscard]] std::unique_ptr<participant::ImpactorBackend> make_impactor(const EngineOptions& options);

/// For the other ranks: takes part in everything rank 0 does; returns when rank 0's impactor is destroyed.
/// A failure is reported by rank 0; where LAMMPS fails on one rank alone, the whole MPI job is aborted.
void follow(const EngineOptions& options);

}  // namespace grainstep::dem
