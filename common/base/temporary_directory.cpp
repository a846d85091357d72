#include "base/temporary_directory.hpp"

#include <filesystem>
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
  try {
    directory_.emplace(parent);
  } catch (const std::system_error& error) {
    throw InputError(parent.string() + ": no temporary directory can be made: " + error.code().message() +
                     ". Set TMPDIR to a directory that can be written.");
  }
}

}  // namespace grainstep
