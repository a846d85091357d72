/// @file A directory that only its owner may enter, gone when this object is: home of local sockets, and of tests'
/// files.
#pragma once

#include <filesystem>

namespace grainstep {

class TemporaryDirectory {
 public:
  /// In $TMPDIR or /tmp; in /tmp in any case where a socket's path would become too long. Throws InputError.
  TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory();

  /// Before its time; once is enough.
  void remove() noexcept;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool removed_ = false;
};

}  // namespace grainstep
