/// @file The directory of one run: what is in it, and the rules for using one.
#pragma once

#include <filesystem>

namespace grainstep::results {

/// What to do with a run that is already there.
enum class Existing { refuse, replace };

class RunDirectory {
 public:
  /// A view of `path`; touches nothing.
  explicit RunDirectory(std::filesystem::path path) : path_(std::move(path)) {}

  /// Makes it ready for a new run: exists, is writable, holds no older run. Throws InputError that names what is in the
  /// way and what to do. `replace` removes the older run's own files and nothing else.
  void prepare(Existing existing) const;

  [[nodiscard]] bool holds_a_run() const;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path results() const { return path_ / "results.h5"; }
  [[nodiscard]] std::filesystem::path summary() const { return path_ / "summary.json"; }
  [[nodiscard]] std::filesystem::path scene() const { return path_ / "scene.resolved.yaml"; }
  [[nodiscard]] std::filesystem::path paraview() const { return path_ / "paraview"; }
  [[nodiscard]] std::filesystem::path logs() const { return path_ / "logs"; }

 private:
  void remove_run() const;
  void require_writable() const;

  std::filesystem::path path_;
};

}  // namespace grainstep::results
