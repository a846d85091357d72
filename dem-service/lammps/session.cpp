#include "dem-service/lammps/session.hpp"

#include "dem-service/lammps/adapter.hpp"

#define LAMMPS_LIB_MPI  // library.h declares lammps_open only then
#include <lammps/library.h>

#include <array>
#include <cstdio>
#include <vector>

#include "base/error.hpp"

// The program's own definitions take precedence over the shared library's, for its internal calls as well.
namespace LAMMPS_NS {

void Error::all(const std::string& /*file*/, int /*line*/, const std::string& text) {
  throw grainstep::dem::LammpsFailure(text, true);
}

void Error::one(const std::string& /*file*/, int /*line*/, const std::string& text) {
  throw grainstep::dem::LammpsFailure(text, false);
}

}  // namespace LAMMPS_NS

namespace grainstep::dem {

LammpsSession::LammpsSession(MPI_Comm communicator, const std::string& log) : communicator_(communicator) {
  std::vector<std::string> words{"grainstep-dem", "-log", log.empty() ? "none" : log, "-screen", "none", "-nocite"};
  std::vector<char*> arguments;
  arguments.reserve(words.size());
  for (std::string& word : words) arguments.push_back(word.data());
  handle_ = lammps_open(static_cast<int>(arguments.size()), arguments.data(), communicator, nullptr);
  if (handle_ == nullptr) throw NumericalError("LAMMPS could not be started");
}

LammpsSession::~LammpsSession() { lammps_close(handle_); }

void LammpsSession::command(const std::string& text) {
  guarded("at `" + text + "`", [&] { lammps_command(handle_, text.c_str()); });
}

bool LammpsSession::run_script(const std::string& path) {
  bool found = false;
  guarded("in " + path, [&] {
    const lammps::UntilRun until_run(lammps());
    try {
      lammps_file(handle_, path.c_str());
    } catch (const lammps::UntilRun::Reached&) {
      found = true;
    }
  });
  return found;
}

template <typename Work>
void LammpsSession::guarded(const std::string& where, Work&& work) {
  try {
    work();
  } catch (const LammpsFailure& failure) {
    const std::string message = "LAMMPS, " + where + ": " + failure.what();
    int ranks = 1;
    MPI_Comm_size(communicator_, &ranks);
    if (ranks > 1 && !failure.on_every_rank()) {
      std::fprintf(stderr, "grainstep-dem: %s (on one rank alone: the MPI job is aborted)\n", message.c_str());
      MPI_Abort(communicator_, static_cast<int>(ExitCode::numerical));
    }
    throw NumericalError(message);
  }
}

void LammpsSession::create_particles(const NewParticles& particles) {
  const std::vector<int> type(particles.identity.size(), 1);
  lammps_create_atoms(handle_, static_cast<int>(type.size()), particles.identity.data(), type.data(),
                      particles.position.data(), particles.velocity.data(), nullptr, 0);
}

}  // namespace grainstep::dem
