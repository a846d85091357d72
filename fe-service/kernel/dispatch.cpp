#include <array>
#include <vector>

#include "base/instruction_set.hpp"
#include "fe-service/kernel/kernel.hpp"

namespace grainstep::fe {

// Defined by the copies of kernel.cpp.
#if defined(__x86_64__) && !defined(GRAINSTEP_ONE_KERNEL)
extern const Kernels kernels_x86_64;
extern const Kernels kernels_x86_64_v3;
extern const Kernels kernels_x86_64_v4;
#else
extern const Kernels kernels_generic;
#endif

namespace {

std::vector<const Kernels*> detect() {
  std::vector<const Kernels*> found;
#if defined(__x86_64__) && !defined(GRAINSTEP_ONE_KERNEL)
  if (x86_level() >= X86Level::v4) found.push_back(&kernels_x86_64_v4);
  if (x86_level() >= X86Level::v3) found.push_back(&kernels_x86_64_v3);
  found.push_back(&kernels_x86_64);
#else
  found.push_back(&kernels_generic);
#endif
  return found;
}

}  // namespace

std::span<const Kernels* const> available_kernels() {
  static const std::vector<const Kernels*> kernels = detect();
  return kernels;
}

}  // namespace grainstep::fe
