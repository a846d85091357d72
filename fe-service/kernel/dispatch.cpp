#include <array>
#include <vector>

#include "fe-service/kernel/kernel.hpp"

namespace grainstep::fe {

// Defined by the copies of kernel.cpp.
extern const Kernels kernels_x86_64;
extern const Kernels kernels_x86_64_v3;
extern const Kernels kernels_x86_64_v4;

namespace {

std::vector<const Kernels*> detect() {
  std::vector<const Kernels*> found;
  __builtin_cpu_init();
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512cd");
  if (v4) found.push_back(&kernels_x86_64_v4);
  if (v3) found.push_back(&kernels_x86_64_v3);
  found.push_back(&kernels_x86_64);
  return found;
}

}  // namespace

std::span<const Kernels* const> available_kernels() {
  static const std::vector<const Kernels*> kernels = detect();
  return kernels;
}

}  // namespace grainstep::fe
