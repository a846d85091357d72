/// @file Where programs are, and how one becomes an MPI program of several ranks.
#pragma once

#include <filesystem>
#include <string>

#include "process/child_process.hpp"

namespace grainstep::process {

/// The program of that name beside the running one, else in PATH; a `name` with a slash is taken as a path. InputError
/// that says where it was looked for.
[[nodiscard]] std::filesystem::path find_program(const std::string& name);

/// `command` with what Open MPI needs to run it on this host: alone as a singleton, or with mpirun for more ranks.
///
/// mpirun puts every rank into a process group of its own and ends them when it receives SIGTERM, when one of them
/// fails, and (by its own connection to them) soon after it was killed. Ranks are started through `setpriv --pdeathsig
/// KILL`, where the system has it, so that the kernel ends them with mpirun in any case; mpirun ends with its starter
/// (child_process.hpp). No rank outlives the orchestrator.
[[nodiscard]] Command mpi_command(int ranks, Command command);

}  // namespace grainstep::process
