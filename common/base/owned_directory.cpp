#include "base/owned_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace grainstep {
namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "grainstep-";
constexpr const char* lock_name = "owner";
constexpr const char* unlocked_name = "owner.new";  // nobody looks at it: who made it has not locked it yet

[[noreturn]] void fail(const fs::path& what) { throw std::system_error(errno, std::generic_category(), what.string()); }

fs::path made_in(const fs::path& parent) {
  std::string pattern = (parent / (std::string(prefix) + "XXXXXX")).string();
  if (::mkdtemp(pattern.data()) == nullptr) fail(pattern);  // mode 0700
  return pattern;
}

void remove_tree(const fs::path& path) noexcept {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

Descriptor locked_in(const fs::path& directory) {
  Descriptor lock(::open((directory / unlocked_name).c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!lock.is_open()) {
    const int error = errno;
    remove_tree(directory);
    throw std::system_error(error, std::generic_category(), directory.string());
  }
  // Where the file system knows no locks, it keeps the name that nobody looks at.
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) == 0) {
    static_cast<void>(::rename((directory / unlocked_name).c_str(), (directory / lock_name).c_str()));
  }
  return lock;
}

/// Nobody else's, and no link to anywhere.
bool is_ours(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
         (status.st_mode & 0077) == 0;
}

bool is_abandoned(const fs::path& directory) {
  if (!directory.filename().native().starts_with(prefix) || !is_ours(directory)) return false;
  const Descriptor lock(::open((directory / lock_name).c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC));
  return lock.is_open() && ::flock(lock.get(), LOCK_EX | LOCK_NB) == 0;
}

}  // namespace

OwnedDirectory::OwnedDirectory(const fs::path& parent)
    : path_((remove_abandoned_directories(parent), made_in(parent))), lock_(locked_in(path_)) {}

void OwnedDirectory::remove() noexcept {
  if (!lock_.is_open()) return;  // moved away, or removed before
  remove_tree(path_);
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
