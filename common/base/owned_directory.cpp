#include "base/owned_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

namespace grainstep {
namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "grainstep-";
constexpr const char* unlocked = ".";  // in front of it: nobody looks at one that its maker has not locked yet

[[noreturn]] void fail(const fs::path& what) { throw std::system_error(errno, std::generic_category(), what.string()); }

void remove_tree(const fs::path& path) noexcept {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

/// -1 where the file system has no locks, or the directory is not to be had.
Descriptor locked(const fs::path& directory) {
  Descriptor lock(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (lock.is_open() && ::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) lock.close();
  return lock;
}

/// Nobody else's, and no link to anywhere.
bool is_ours(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
         (status.st_mode & 0077) == 0;
}

bool is_abandoned(const fs::path& directory) {
  return directory.filename().native().starts_with(prefix) && is_ours(directory) && locked(directory).is_open();
}

}  // namespace

OwnedDirectory::OwnedDirectory(const fs::path& parent) {
  remove_abandoned_directories(parent);
  std::string made = (parent / (std::string(unlocked) + prefix + "XXXXXX")).string();
  if (::mkdtemp(made.data()) == nullptr) fail(made);  // mode 0700
  lock_ = locked(made);
  path_ = parent / fs::path(made).filename().native().substr(1);
  if (::rename(made.c_str(), path_.c_str()) == 0) return;
  const int error = errno;
  remove_tree(made);
  throw std::system_error(error, std::generic_category(), path_.string());
}

OwnedDirectory::OwnedDirectory(OwnedDirectory&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::move(other.lock_)) {}

void OwnedDirectory::remove() noexcept {
  if (path_.empty() || removed_) return;  // moved away, or removed before
  remove_tree(path_);
  removed_ = true;
  lock_.close();
}

void remove_abandoned_directories(const fs::path& parent) noexcept {
  try {
    std::error_code end;
    for (fs::directory_iterator entry(parent, end); !end && entry != fs::directory_iterator(); entry.increment(end)) {
      if (is_abandoned(entry->path())) remove_tree(entry->path());
    }
  } catch (const std::exception&) {  // no memory for a name: somebody else will find it
  }
}

}  // namespace grainstep
