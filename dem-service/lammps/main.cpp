/// @file grainstep-dem: the particle impactor as a program. Rank 0 talks to the orchestrator, the others follow.
#include "base/error.hpp"
#include "dem-service/lammps/impactor.hpp"
#include "dem-service/mpi_start.hpp"
#include "participant/program.hpp"
#include "participant/serve.hpp"

namespace {

int serve(const grainstep::participant::Program& program, const grainstep::dem::EngineOptions& options) {
  // Made first, so that its end sends the other ranks home whatever happens to the connection.
  const auto impactor = grainstep::dem::make_impactor(options);
  return program.run([&impactor, &program](grainstep::transport::Channel& channel) {
    return grainstep::participant::serve_impactor(channel, *impactor, program.serving());
  });
}

}  // namespace

int main(int argc, char** argv) {
  grainstep::participant::Program program(
      "grainstep-dem", GRAINSTEP_VERSION,
      "grainstep-dem: particles for Grainstep, computed by LAMMPS. Under mpirun all ranks share the slug.");
  grainstep::dem::EngineOptions options;
  program.option("lammps-log", "Write LAMMPS's own log to this file", options.lammps_log);
  program.flag("allow-deck", "Run LAMMPS scripts (impactor.type: deck), which can do anything on this machine",
               options.allow_deck);
  if (const auto code = program.parse(argc, argv)) return *code;
  int rank = 0;
  if (!grainstep::dem::is_alone()) {
    grainstep::dem::start_mpi();
    options.communicator = MPI_COMM_WORLD;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  }
  int code = static_cast<int>(grainstep::ExitCode::done);
  if (rank == 0) {
    code = serve(program, options);
  } else {
    grainstep::dem::follow(options);
  }
  grainstep::dem::end_mpi();
  return code;
}
