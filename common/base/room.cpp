#include "base/room.hpp"

#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>
#include <system_error>
#include <thread>

#include "base/descriptor.hpp"
#include "base/error.hpp"

namespace grainstep::base {
namespace {

constexpr std::size_t descriptors = 40;                         // two channels of libzmq, files, processes
constexpr std::size_t threads = 5;                              // two for each channel, one that writes
constexpr std::size_t address_space = std::size_t{512} << 20U;  // stacks of threads, libraries' heaps, MPI

std::string limit_text(int resource, double unit = 1.0, const std::string& unit_name = "") {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return "";
  return " (the limit is " + std::to_string(static_cast<long long>(static_cast<double>(limit.rlim_cur) / unit)) +
         unit_name + ")";
}

void require_descriptors() {
  std::array<Descriptor, descriptors> probes;
  for (Descriptor& probe : probes) {
    probe = Descriptor(::eventfd(0, EFD_CLOEXEC));
    if (probe.is_open()) continue;
    throw InputError("the system gives this process no more open files" + limit_text(RLIMIT_NOFILE) + ": " +
                     std::strerror(errno) + "; it needs " + std::to_string(descriptors) + ". Raise it: ulimit -n 1024");
  }
}

void require_threads() {
  std::array<std::thread, threads> probes;
  std::string refused;
  for (std::thread& probe : probes) {
    try {
      probe = std::thread([] {});
    } catch (const std::system_error& error) {
      refused = error.code().message();
      break;
    }
  }
  for (std::thread& probe : probes) {
    if (probe.joinable()) probe.join();
  }
  if (refused.empty()) return;
  throw InputError("the system gives this process no more threads" + limit_text(RLIMIT_NPROC) + ": " + refused +
                   "; it needs " + std::to_string(threads) + ". Raise it: ulimit -u");
}

void require_address_space() {
  void* const probe = ::mmap(nullptr, address_space, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (probe == MAP_FAILED) {
    throw InputError("the system gives this process too little memory" +
                     limit_text(RLIMIT_AS, 1048576.0, " MiB of addresses") + ": " + std::strerror(errno) +
                     "; it needs " + std::to_string(address_space >> 20U) +
                     " MiB beside what it has. Raise it: ulimit -v unlimited");
  }
  ::munmap(probe, address_space);
}

}  // namespace

void require_room() {
  require_descriptors();
  require_address_space();
  require_threads();
}

}  // namespace grainstep::base
