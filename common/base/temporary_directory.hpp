/// @file A directory that only its owner may enter, gone when this object is: home of local sockets, and of tests'
/// files.
#pragma once

#include <filesystem>
#include <optional>

#include "base/owned_directory.hpp"

namespace grainstep {

class TemporaryDirectory {
 public:
  /// In $TMPDIR or /tmp; in /tmp in any case where a socket's path would become too long. Throws InputError.
  TemporaryDirectory();

  /// Before its time; once is enough.
  void remove() noexcept { directory_->remove(); }

  [[nodiscard]] const std::filesystem::path& path() const { return directory_->path(); }

 private:
  std::optional<OwnedDirectory> directory_;  ///< from the constructor on
};

}  // namespace grainstep
