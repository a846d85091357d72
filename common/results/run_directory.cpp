#include "results/run_directory.hpp"

#include <system_error>

#include "base/error.hpp"
#include "results/atomic_file.hpp"

namespace grainstep::results {

namespace fs = std::filesystem;

bool RunDirectory::holds_a_run() const {
  std::error_code ignored;
  return fs::exists(results(), ignored) || fs::exists(summary(), ignored) || fs::exists(scene(), ignored);
}

void RunDirectory::remove_run() const {
  std::error_code error;
  for (const fs::path& file : {results(), summary(), scene(), path_ / "particles.pvd", path_ / "structure.pvd"}) {
    if (!error) {
      fs::remove(file, error);
    }
  }
  for (const fs::path& folder : {paraview(), logs()}) {
    if (!error) {
      fs::remove_all(folder, error);
    }
  }
  if (error) {
    throw InputError(path_.string() + ": the run that is there cannot be removed: " + error.message());
  }
}

void RunDirectory::require_writable() const {
  std::error_code error;
  for (const fs::path& folder : {path_, paraview(), logs()}) {
    if (!error) {
      fs::create_directories(folder, error);
    }
  }
  if (error) {
    throw InputError(path_.string() + ": cannot be made: " + error.message() +
                     ". Choose another directory with --out.");
  }
  const fs::path probe = path_ / "write-test";
  try {
    write_atomically(probe, "");
  } catch (const OutputError& refused) {
    throw InputError(std::string(refused.what()) + ". Choose another directory with --out.");
  }
  fs::remove(probe, error);
}

void RunDirectory::prepare(Existing existing) const {
  if (holds_a_run()) {
    if (existing == Existing::refuse) {
      throw InputError(path_.string() +
                       ": holds a run already. Choose another directory with --out, or replace it with --force.");
    }
    remove_run();
  }
  require_writable();
}

}  // namespace grainstep::results
