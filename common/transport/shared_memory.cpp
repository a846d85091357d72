#include "transport/shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace grainstep::transport {
namespace {

constexpr const char* parent = "/dev/shm";

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

Descriptor opened(const std::filesystem::path& file, int flags) {
  Descriptor out(::open(file.c_str(), flags | O_CLOEXEC, 0600));
  if (!out.is_open()) fail(file.string(), errno);
  return out;
}

std::span<std::byte> map(const Descriptor& descriptor, std::size_t bytes, const std::filesystem::path& file) {
  void* const at = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor.get(), 0);
  if (at == MAP_FAILED) fail(file.string(), errno);
  return {static_cast<std::byte*>(at), bytes};
}

}  // namespace

SharedMemory::SharedMemory(std::span<std::byte> bytes, std::filesystem::path file, std::optional<OwnedDirectory> home)
    : bytes_(bytes), file_(std::move(file)), home_(std::move(home)) {}

SharedMemory::SharedMemory(SharedMemory&& other) noexcept
    : bytes_(std::exchange(other.bytes_, {})), file_(std::move(other.file_)), home_(std::move(other.home_)) {}

SharedMemory::~SharedMemory() {
  if (!bytes_.empty()) ::munmap(bytes_.data(), bytes_.size());
}

void SharedMemory::remove_name() noexcept {
  if (home_) home_->remove();
}

SharedMemory SharedMemory::create(std::size_t bytes) {
  OwnedDirectory home(parent);
  std::filesystem::path file = home.path() / "data";
  const Descriptor descriptor = opened(file, O_RDWR | O_CREAT | O_EXCL);
  if (const int error = ::posix_fallocate(descriptor.get(), 0, static_cast<off_t>(bytes))) fail(file.string(), error);
  return {map(descriptor, bytes, file), file, std::move(home)};
}

SharedMemory SharedMemory::open(const std::filesystem::path& file) {
  const Descriptor descriptor = opened(file, O_RDWR);
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) fail(file.string(), errno);
  if (!S_ISREG(status.st_mode) || status.st_size <= 0) fail(file.string(), EINVAL);
  return {map(descriptor, static_cast<std::size_t>(status.st_size), file), file, std::nullopt};
}

}  // namespace grainstep::transport
