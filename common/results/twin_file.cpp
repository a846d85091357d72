#include "results/twin_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/descriptor.hpp"
#include "base/error.hpp"

namespace grainstep::results {

TwinFile::TwinFile(std::filesystem::path visible)
    : visible_(std::move(visible)), twin_(visible_.string() + leftovers[0]), last_(visible_.string() + leftovers[1]) {}

TwinFile::~TwinFile() {
  abandon();
  ::unlink(last_.c_str());
}

void TwinFile::fail(const char* what) const {
  throw OutputError(visible_.string() + ": " + what + ": " + std::strerror(errno) +
                    ". What was written before is readable.");
}

bool TwinFile::open() {
  if (open_) return false;
  ::unlink(twin_.c_str());  // of a link the link
  std::error_code refused;
  std::filesystem::copy_file(visible_, twin_, refused);
  if (refused) {
    errno = refused.value();
    fail("cannot be copied for the next rows");
  }
  open_ = true;
  return true;
}

void TwinFile::exchange() {
  {
    const Descriptor file(::open(twin_.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open() || ::fsync(file.get()) != 0) fail("cannot be made durable");
  }
  // The one step is the rename onto the visible name. What was visible stays reachable by its second name; on file
  // systems without such names it goes, and the next twin is a copy.
  ::unlink(last_.c_str());
  const bool kept = ::link(visible_.c_str(), last_.c_str()) == 0;
  if (::rename(twin_.c_str(), visible_.c_str()) != 0) fail("cannot be replaced by its next version");
  open_ = kept && ::rename(last_.c_str(), twin_.c_str()) == 0;
}

void TwinFile::abandon() noexcept {
  ::unlink(twin_.c_str());
  open_ = false;
}

}  // namespace grainstep::results
