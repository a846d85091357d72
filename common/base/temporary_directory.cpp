#include "base/temporary_directory.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "base/error.hpp"

namespace grainstep {
namespace {

constexpr std::size_t longest_parent = 60;  // a socket's path holds 107 characters

}  // namespace

TemporaryDirectory::TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::path parent = std::filesystem::temp_directory_path(ignored);
  if (parent.empty() || parent.string().size() > longest_parent) {
    parent = "/tmp";
  }
  std::string pattern = (parent / "grainstep-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {  // mode 0700
    throw InputError(parent.string() + ": no temporary directory can be made: " + std::strerror(errno) +
                     ". Set TMPDIR to a directory that can be written.");
  }
  path_ = pattern;
}

TemporaryDirectory::~TemporaryDirectory() { remove(); }

void TemporaryDirectory::remove() noexcept {
  if (!removed_) {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    removed_ = true;
  }
}

}  // namespace grainstep
