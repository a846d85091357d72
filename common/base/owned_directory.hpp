/// @file A directory for as long as its process lives, and what killed processes have left of theirs.
///
/// It lies in one that holds a file besides, the mark, which the owner keeps locked. The lock ends with the process
/// however it ends: a directory with a mark that nobody has locked was left behind, and the next process of the same
/// user takes it away. A directory without a mark is somebody's, whatever its name.
#pragma once

#include <filesystem>

#include "base/descriptor.hpp"

namespace grainstep {

class OwnedDirectory {
 public:
  /// A new one in `parent`, which only this user may enter. Takes away what was left there. std::system_error where it
  /// cannot be made.
  explicit OwnedDirectory(const std::filesystem::path& parent);
  OwnedDirectory(OwnedDirectory&& other) noexcept;
  OwnedDirectory& operator=(OwnedDirectory&&) = delete;
  OwnedDirectory(const OwnedDirectory&) = delete;
  OwnedDirectory& operator=(const OwnedDirectory&) = delete;
  ~OwnedDirectory() { remove(); }

  /// With everything in it, before its time; once is enough.
  void remove() noexcept;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path marked_;  ///< holds `path_` and the mark
  std::filesystem::path path_;
  Descriptor lock_;
  bool removed_ = false;
};

/// Takes away those in `parent` that this user's processes have left.
void remove_abandoned_directories(const std::filesystem::path& parent) noexcept;

}  // namespace grainstep
