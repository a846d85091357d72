#include "results/directory_lock.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "base/error.hpp"

namespace grainstep::results {
namespace {

constexpr int link_is_refused = O_NOFOLLOW | O_CLOEXEC;

struct flock whole_file() {
  struct flock out {};
  out.l_type = F_WRLCK;
  out.l_whence = SEEK_SET;
  return out;
}

std::string own_name() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on " + host.data();
}

// One line of ours; what else stands there is not told.
std::string holder_in(int file) {
  std::array<char, 320> text{};
  const ssize_t length = ::pread(file, text.data(), text.size() - 1, 0);
  const std::string out(text.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
  const std::size_t end = out.find('\n');
  return out.starts_with("process ") && end != std::string::npos ? out.substr(0, end) : "";
}

[[noreturn]] void refuse(const std::filesystem::path& lock_file, const std::string& what, const std::string& holder) {
  throw InputError(lock_file.parent_path().string() + ": " + what + " works in this directory" +
                   (holder.empty() ? "" : " (" + holder + ")") +
                   ". Wait for its end, or stop it (kill with that process's number), or choose another directory with "
                   "--out.");
}

void write_holder(int file) {
  const std::string line = own_name() + "\n";
  const bool written = ::ftruncate(file, 0) == 0 && ::pwrite(file, line.data(), line.size(), 0) > 0;
  static_cast<void>(written);  // a full disk; the lock is what counts, the name is for people
}

}  // namespace

Occupation occupation(const std::filesystem::path& lock_file) {
  const Descriptor file(::open(lock_file.c_str(), O_RDONLY | link_is_refused));
  if (!file.is_open()) return {};
  const std::string holder = holder_in(file.get());
  struct flock asked = whole_file();
  if (::fcntl(file.get(), F_OFD_GETLK, &asked) != 0) return {};
  if (asked.l_type != F_UNLCK) return {.state = Occupation::State::held, .holder = holder};
  return holder.empty() ? Occupation() : Occupation{.state = Occupation::State::left, .holder = holder};
}

DirectoryLock::DirectoryLock(const std::filesystem::path& lock_file, const std::string& what)
    : file_(::open(lock_file.c_str(), O_RDWR | O_CREAT | link_is_refused, 0644)) {
  if (!file_.is_open()) {
    throw InputError(lock_file.string() + ": cannot be written: " + std::strerror(errno) +
                     ". Choose another directory with --out.");
  }
  struct flock wanted = whole_file();
  if (::fcntl(file_.get(), F_OFD_SETLK, &wanted) == 0) {
    write_holder(file_.get());
  } else if (errno == EAGAIN || errno == EACCES) {
    refuse(lock_file, what, holder_in(file_.get()));
  } else {  // some network file systems have no locks: nobody is kept out, and no name says that somebody was
    static_cast<void>(!::ftruncate(file_.get(), 0));
  }
}

}  // namespace grainstep::results
