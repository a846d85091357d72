#include "process/launch.hpp"

#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <sstream>

#include "base/error.hpp"
#include "base/team.hpp"

namespace grainstep::process {
namespace {

namespace fs = std::filesystem;

/// A folder that may not be looked into holds none.
bool is_program(const fs::path& path) {
  std::error_code refused;
  return fs::is_regular_file(path, refused) && ::access(path.c_str(), X_OK) == 0;
}

std::optional<fs::path> in_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (const fs::path candidate = fs::path(folder) / name; !folder.empty() && is_program(candidate)) {
      return candidate;
    }
  }
  return std::nullopt;
}

void add_open_mpi_environment(Command& command) {
  if (::geteuid() == 0) {  // usual in containers
    command.environment.emplace_back("OMPI_ALLOW_RUN_AS_ROOT", "1");
    command.environment.emplace_back("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
}

}  // namespace

fs::path find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    if (is_program(name)) {
      return name;
    }
    throw InputError(name + ": is not a program that can be run");
  }
  fs::path beside = fs::read_symlink("/proc/self/exe").parent_path() / name;
  if (is_program(beside)) {
    return beside;
  }
  if (auto found = in_path(name)) {
    return *found;
  }
  throw InputError(name + ": no such program; looked for " + beside.string() + " and in PATH");
}

Command mpi_command(int ranks, Command command) {
  if (ranks < 1) {
    throw InputError("ranks: found " + std::to_string(ranks) + ", expected 1 or more");
  }
  add_open_mpi_environment(command);
  if (ranks == 1) {
    if (!in_path("orted")) {  // slim images: MPI_Init of a lone process would look for it
      command.environment.emplace_back("OMPI_MCA_ess_singleton_isolated", "1");
    }
    return command;
  }
  Command run;
  run.program = find_program("mpirun");
  run.environment = command.environment;
  // Not bound to cores: the other participant and the orchestrator share them, and the kernel knows which are free.
  run.arguments = {"-np", std::to_string(ranks), "--bind-to", "none"};
  if (ranks > base::usable_cores()) {
    run.arguments.emplace_back("--oversubscribe");
  }
  if (const auto setpriv = in_path("setpriv")) {
    run.arguments.insert(run.arguments.end(), {setpriv->string(), "--pdeathsig", "KILL"});
  }
  run.arguments.push_back(command.program.string());
  run.arguments.insert(run.arguments.end(), command.arguments.begin(), command.arguments.end());
  return run;
}

}  // namespace grainstep::process
