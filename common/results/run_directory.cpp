#include "results/run_directory.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "results/atomic_file.hpp"
#include "results/checkpoints.hpp"
#include "results/twin_file.hpp"

namespace grainstep::results {

namespace fs = std::filesystem;

namespace {

// "NAME.part" is a file that was being written when its process was ended (atomic_file.hpp).
std::string without_part(const std::string& name) {
  constexpr std::string_view ending = ".part";
  return name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
}

// NAME_0000.vtp and so on: at least four digits.
bool is_snapshot(const std::string& file, const std::string& series) {
  const std::string begin = series + "_";
  if (!file.starts_with(begin) || !(file.ends_with(".vtp") || file.ends_with(".vtu"))) return false;
  const std::string number = file.substr(begin.size(), file.size() - begin.size() - 4);
  return number.size() >= 4 && number.find_first_not_of("0123456789") == std::string::npos;
}

// Whether a run wrote this file into one of its folders; people may keep theirs beside it.
bool is_a_runs_own(const std::string& file) {
  const std::string name = without_part(file);
  return name == "impactor.log" || name == "structure.log" || Checkpoints::is_one(name) ||
         std::ranges::any_of(series_names, [&](const char* series) { return is_snapshot(name, series); });
}

std::vector<fs::path> own_files_in(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> found;
  const fs::file_status status = fs::symlink_status(folder, error);
  if (status.type() == fs::file_type::not_found) {
    error.clear();
  } else if (!error && fs::is_directory(status)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      if (is_a_runs_own(entry.path().filename().string())) {
        found.push_back(entry.path());
      }
    }
  }
  return found;
}

// Itself, be it a link to somewhere else or to nowhere.
bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

}  // namespace

bool RunDirectory::holds_a_run() const { return is_there(results()) || is_there(summary()) || is_there(scene()); }

void RunDirectory::remove_run() const {
  std::error_code error;
  std::vector<fs::path> files = {summary(), results(), record(), scene()};
  for (const char* name : series_names) files.push_back(series(name));
  for (std::size_t i = 0, whole = files.size(); i < whole; ++i) files.emplace_back(files[i].string() + ".part");
  for (const char* left : TwinFile::leftovers) {
    files.emplace_back(results().string() + left);
    files.emplace_back(record().string() + left);
  }
  for (const fs::path& folder : {paraview(), logs(), checkpoints()}) {
    if (!error) {
      const std::vector<fs::path> own = own_files_in(folder, error);
      files.insert(files.end(), own.begin(), own.end());
    }
  }
  for (const fs::path& file : files) {
    if (!error) {
      fs::remove(file, error);  // of a link the link
    }
  }
  if (error) {
    throw InputError(path_.string() + ": the run that is there cannot be removed: " + error.message());
  }
}

void RunDirectory::make(const fs::path& folder) const {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(path_.string() + ": cannot be made: " + error.message() +
                     ". Choose another directory with --out.");
  }
}

void RunDirectory::require_own_folders() const {
  for (const fs::path& folder : {paraview(), logs(), checkpoints()}) {
    std::error_code ignored;
    if (fs::is_symlink(folder, ignored)) {
      throw InputError(folder.string() +
                       ": is a link. A run writes into its own directory only: remove the link, or choose another "
                       "directory with --out.");
    }
  }
}

void RunDirectory::require_writable() const {
  make(paraview());
  make(logs());
  const fs::path probe = path_ / "write-test";
  try {
    write_atomically(probe, "");
  } catch (const OutputError& refused) {
    throw InputError(std::string(refused.what()) + ". Choose another directory with --out.");
  }
  std::error_code ignored;
  fs::remove(probe, ignored);
}

void RunDirectory::refuse() const {
  throw InputError(path_.string() +
                   ": holds a run already. Choose another directory with --out, or replace it with --force.");
}

DirectoryLock RunDirectory::prepare(Existing existing) const {
  const bool refused = existing == Existing::refuse;
  // Said before anything is touched, but not of a run in progress: of that one, the lock says more.
  if (refused && holds_a_run() && occupation().state != Occupation::State::held) refuse();
  make(path_);
  DirectoryLock entered(lock(), "a run");
  require_own_folders();
  if (holds_a_run()) {
    if (refused) refuse();  // it came and went since we looked
    if (existing == Existing::replace) remove_run();
  }
  require_writable();
  return entered;
}

}  // namespace grainstep::results
