/// @file The directory of one run: what is in it, and the rules for using one.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "results/directory_lock.hpp"

namespace grainstep::results {

/// What to do with a run that is already there.
enum class Existing { refuse, replace, go_on };

/// The time series of snapshots that a run may have: NAME.pvd, with its files paraview/NAME_NNNN.vtp or .vtu.
inline constexpr std::array series_names{"particles", "impactor", "structure"};

class RunDirectory {
 public:
  /// A view of `path`; touches nothing.
  explicit RunDirectory(std::filesystem::path path) : path_(std::move(path)) {}

  /// Makes it ready for a new run: exists, is writable, holds no older run, nobody works in it. Throws InputError that
  /// names what is in the way and what to do. `replace` removes the older run's own files and nothing else, and follows
  /// no links; `go_on` leaves them. The run keeps the lock as long as it writes.
  [[nodiscard]] DirectoryLock prepare(Existing existing) const;

  /// What a run leaves first, or last, is there.
  [[nodiscard]] bool holds_a_run() const;

  /// Whether the run that is there is alive.
  [[nodiscard]] Occupation occupation() const { return results::occupation(lock()); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path lock() const { return path_ / "run.lock"; }
  [[nodiscard]] std::filesystem::path results() const { return path_ / "results.h5"; }
  [[nodiscard]] std::filesystem::path record() const { return path_ / "surface.h5"; }
  [[nodiscard]] std::filesystem::path summary() const { return path_ / "summary.json"; }
  [[nodiscard]] std::filesystem::path scene() const { return path_ / "scene.resolved.yaml"; }
  [[nodiscard]] std::filesystem::path series(const std::string& name) const { return path_ / (name + ".pvd"); }
  [[nodiscard]] std::filesystem::path paraview() const { return path_ / "paraview"; }
  [[nodiscard]] std::filesystem::path logs() const { return path_ / "logs"; }
  [[nodiscard]] std::filesystem::path checkpoints() const { return path_ / "checkpoints"; }

 private:
  [[noreturn]] void refuse() const;
  void make(const std::filesystem::path& folder) const;
  void remove_run() const;
  void require_own_folders() const;
  void require_writable() const;

  std::filesystem::path path_;
};

}  // namespace grainstep::results
