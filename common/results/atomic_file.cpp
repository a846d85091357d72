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

enum class Durable { no, yes };

bool sync_directory_of(const std::filesystem::path& path) {
  const Descriptor directory(::open(path.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return directory.is_open() && ::fsync(directory.get()) == 0;
}

void write(const std::filesystem::path& path, std::string_view contents, Durable durable) {
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
    if (durable == Durable::yes && ::fsync(file.get()) != 0) fail();
  }
  if (::rename(beside.c_str(), path.c_str()) != 0) {
    fail();
  }
  if (durable == Durable::yes && !sync_directory_of(path)) fail();
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::string_view contents) {
  write(path, contents, Durable::no);
}

void write_durably(const std::filesystem::path& path, std::string_view contents) {
  write(path, contents, Durable::yes);
}

}  // namespace grainstep::results
