#include "results/run_directory.hpp"

#include <string>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "results/atomic_file.hpp"

namespace grainstep::results {

namespace fs = std::filesystem;

namespace {

bool has_form(const fs::path& file, const std::string& stem, const std::string& extension) {
  return file.extension() == extension && file.stem().string().starts_with(stem);
}

// Whether a run wrote this file into its paraview/ or logs/; people may keep theirs beside it.
bool is_a_runs_own(const fs::path& file) {
  return has_form(file, "particles_", ".vtp") || has_form(file, "structure_", ".vtu") ||
         has_form(file, "impactor", ".log") || has_form(file, "structure", ".log") || file.extension() == ".part";
}

std::vector<fs::path> own_files_in(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> found;
  if (fs::is_directory(folder, error)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      if (is_a_runs_own(entry.path())) {
        found.push_back(entry.path());
      }
    }
  } else if (error == std::errc::no_such_file_or_directory) {
    error.clear();
  }
  return found;
}

}  // namespace

bool RunDirectory::holds_a_run() const {
  std::error_code ignored;
  return fs::exists(results(), ignored) || fs::exists(summary(), ignored) || fs::exists(scene(), ignored);
}

void RunDirectory::remove_run() const {
  std::error_code error;
  std::vector<fs::path> files = {results(), summary(), scene(), path_ / "particles.pvd", path_ / "structure.pvd"};
  for (const fs::path& folder : {paraview(), logs()}) {
    if (!error) {
      const std::vector<fs::path> own = own_files_in(folder, error);
      files.insert(files.end(), own.begin(), own.end());
    }
  }
  for (const fs::path& file : files) {
    if (!error) {
      fs::remove(file, error);
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
