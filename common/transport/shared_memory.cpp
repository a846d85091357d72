#include "transport/shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

namespace grainstep::transport {
namespace {

constexpr const char* parent = "/dev/shm";

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags) : number_(::open(file.c_str(), flags | O_CLOEXEC, 0600)) {
    if (number_ < 0) fail(file.string(), errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(number_); }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

std::span<std::byte> map(const Descriptor& descriptor, std::size_t bytes, const std::filesystem::path& file) {
  void* const at = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor.number(), 0);
  if (at == MAP_FAILED) fail(file.string(), errno);
  return {static_cast<std::byte*>(at), bytes};
}

void remove_with_directory(const std::filesystem::path& file) noexcept {
  std::error_code ignored;
  std::filesystem::remove_all(file.parent_path(), ignored);
}

}  // namespace

SharedMemory::SharedMemory(std::span<std::byte> bytes, std::filesystem::path file, bool mine)
    : bytes_(bytes), file_(std::move(file)), named_(mine) {}

SharedMemory::SharedMemory(SharedMemory&& other) noexcept
    : bytes_(std::exchange(other.bytes_, {})),
      file_(std::move(other.file_)),
      named_(std::exchange(other.named_, false)) {}

SharedMemory::~SharedMemory() {
  remove_name();
  if (!bytes_.empty()) ::munmap(bytes_.data(), bytes_.size());
}

void SharedMemory::remove_name() noexcept {
  if (std::exchange(named_, false)) remove_with_directory(file_);
}

SharedMemory SharedMemory::create(std::size_t bytes) {
  std::string directory = std::string(parent) + "/grainstep-XXXXXX";
  if (::mkdtemp(directory.data()) == nullptr) fail(directory, errno);  // mode 0700
  std::filesystem::path file = std::filesystem::path(directory) / "data";
  try {
    const Descriptor descriptor(file, O_RDWR | O_CREAT | O_EXCL);
    if (const int error = ::posix_fallocate(descriptor.number(), 0, static_cast<off_t>(bytes)))
      fail(file.string(), error);
    return {map(descriptor, bytes, file), file, true};
  } catch (...) {
    remove_with_directory(file);
    throw;
  }
}

SharedMemory SharedMemory::open(const std::filesystem::path& file) {
  const Descriptor descriptor(file, O_RDWR);
  struct stat status {};
  if (::fstat(descriptor.number(), &status) != 0) fail(file.string(), errno);
  if (!S_ISREG(status.st_mode) || status.st_size <= 0) fail(file.string(), EINVAL);
  return {map(descriptor, static_cast<std::size_t>(status.st_size), file), file, false};
}

}  // namespace grainstep::transport
