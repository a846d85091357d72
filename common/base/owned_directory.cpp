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
// A name proves nothing: people have directories of that name too. This file, which its owner keeps locked, does.
constexpr const char* mark = "of-a-process-of-grainstep";
constexpr const char* unlocked = "new";  // the mark's name until it is locked: nobody looks at it before
constexpr const char* inside = "in";

[[noreturn]] void fail(const fs::path& what, int error) {
  throw std::system_error(error, std::generic_category(), what.string());
}

/// The mark last: what is left of a removal that was cut off can be recognized.
void remove_marked(const fs::path& path) noexcept {
  std::error_code ignored;
  fs::remove_all(path / inside, ignored);
  fs::remove_all(path, ignored);
}

/// -1 where the file system has no locks, somebody holds it, or it is no file of its own.
Descriptor locked(const fs::path& file, int flags) {
  Descriptor lock(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | flags, 0600));
  struct stat status {};
  if (!lock.is_open() || ::fstat(lock.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) return {};
  return lock;
}

/// Nobody else's, and no link to anywhere.
bool is_ours(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
         (status.st_mode & 0077) == 0;
}

bool is_abandoned(const fs::path& directory) {
  return directory.filename().native().starts_with(prefix) && is_ours(directory) &&
         locked(directory / mark, 0).is_open();
}

}  // namespace

OwnedDirectory::OwnedDirectory(const fs::path& parent) {
  remove_abandoned_directories(parent);
  std::string made = (parent / (std::string(prefix) + "XXXXXX")).string();
  if (::mkdtemp(made.data()) == nullptr) fail(made, errno);  // mode 0700
  marked_ = made;
  path_ = marked_ / inside;
  lock_ = locked(marked_ / unlocked, O_CREAT | O_EXCL);
  const bool is_marked = !lock_.is_open() || ::rename((marked_ / unlocked).c_str(), (marked_ / mark).c_str()) == 0;
  if (is_marked && ::mkdir(path_.c_str(), 0700) == 0) return;
  const int error = errno;
  remove_marked(marked_);
  fail(path_, error);
}

OwnedDirectory::OwnedDirectory(OwnedDirectory&& other) noexcept
    : marked_(std::exchange(other.marked_, {})), path_(std::exchange(other.path_, {})), lock_(std::move(other.lock_)) {}

void OwnedDirectory::remove() noexcept {
  if (path_.empty() || removed_) return;  // moved away, or removed before
  remove_marked(marked_);
  removed_ = true;
  lock_.close();
}

void remove_abandoned_directories(const fs::path& parent) noexcept {
  try {
    std::error_code end;
    for (fs::directory_iterator entry(parent, end); !end && entry != fs::directory_iterator(); entry.increment(end)) {
      if (is_abandoned(entry->path())) remove_marked(entry->path());
    }
  } catch (const std::exception&) {  // no memory for a name: somebody else will find it
  }
}

}  // namespace grainstep
