/// @file Who works in a directory: at most one run, at most one study.
///
/// The lock is the kernel's, on an open file (fcntl(2), "open file description locks"): it ends with the process that
/// holds it, whatever ends that, and asking about it disturbs nobody. The file stays, and holds the name of its last
/// holder.
#pragma once

#include <filesystem>
#include <string>

#include "base/descriptor.hpp"

namespace grainstep::results {

/// What a lock file says of its directory.
struct Occupation {
  enum class State {
    unknown,  ///< no such file, or a file system that knows no locks
    held,     ///< by a process that is alive
    left      ///< there was a holder, and it has ended
  };
  State state = State::unknown;
  std::string holder;  ///< "process 1234 on node17", the last one; empty where it is not known
};

/// Looks, and changes nothing.
[[nodiscard]] Occupation occupation(const std::filesystem::path& lock_file);

class DirectoryLock {
 public:
  /// Takes it, or throws InputError: somebody holds it (`what` works there, e.g. "a run"; with the holder's process id
  /// and what to do), or the file cannot be written. Where the file system knows no locks, nothing is locked.
  DirectoryLock(const std::filesystem::path& lock_file, const std::string& what);

 private:
  Descriptor file_;
};

}  // namespace grainstep::results
