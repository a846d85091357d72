/// @file grainstep-dem: the particle impactor as a program. Rank 0 talks to the orchestrator, the others follow.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/error.hpp"
#include "dem-service/impactor.hpp"
#include "dem-service/mpi_start.hpp"
#include "participant/connect.hpp"
#include "participant/serve.hpp"

namespace {

using grainstep::ExitCode;

ExitCode serve(const grainstep::participant::ConnectOptions& connect, const grainstep::dem::EngineOptions& options) {
  // Made first, so that its end sends the other ranks home whatever happens to the connection.
  const auto impactor = grainstep::dem::make_impactor(options);
  try {
    const auto channel = grainstep::participant::open(connect);
    return static_cast<ExitCode>(grainstep::participant::serve_impactor(*channel, *impactor));
  } catch (const grainstep::InputError& error) {
    std::fprintf(stderr, "grainstep-dem: %s\n", error.what());
    return ExitCode::bad_input;
  } catch (const grainstep::PeerError& error) {
    std::fprintf(stderr, "grainstep-dem: %s\n", error.what());
    return ExitCode::peer;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("grainstep-dem: particles for Grainstep, computed by LAMMPS. Under mpirun all ranks share the slug.");
  grainstep::participant::ConnectOptions connect;
  grainstep::dem::EngineOptions options;
  grainstep::participant::add_connect_options(app, connect);
  app.add_option("--lammps-log", options.lammps_log, "Write LAMMPS's own log to this file");
  app.set_version_flag("--version", GRAINSTEP_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_input);
  }
  grainstep::dem::start_mpi();
  options.communicator = MPI_COMM_WORLD;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  auto code = ExitCode::done;
  if (rank == 0) {
    code = serve(connect, options);
  } else {
    grainstep::dem::follow(options);
  }
  MPI_Finalize();
  return static_cast<int>(code);
}
