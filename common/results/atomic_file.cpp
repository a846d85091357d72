#include "results/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/descriptor.hpp"
#include "base/error.hpp"

namespace grainstep::results {
namespace {

bool write_all(int fd, std::string_view contents) {
  while (!contents.empty()) {
    const ssize_t written = ::write(fd, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      return false;
    }
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::string_view contents) {
  const std::filesystem::path beside = path.string() + ".part";
  const auto fail = [&] {
    const int reason = errno;
    ::unlink(beside.c_str());
    throw OutputError(path.string() + ": cannot be written: " + std::strerror(reason));
  };
  {
    const Descriptor file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666));
    if (file.get() < 0 || !write_all(file.get(), contents)) {
      fail();
    }
  }
  if (::rename(beside.c_str(), path.c_str()) != 0) {
    fail();
  }
}

}  // namespace grainstep::results
