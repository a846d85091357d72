#include "base/instruction_set.hpp"

namespace grainstep {

X86Level x86_level() {
#if defined(__x86_64__)
  // By what sets the levels apart; GCC knows them by name, Clang 14 does not.
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("sse4.2")) return X86Level::v1;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi2")) {
    return X86Level::v2;
  }
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd");
  return wide ? X86Level::v4 : X86Level::v3;
#else
  return X86Level::none;
#endif
}

const char* instruction_set_name() {
  switch (x86_level()) {
    case X86Level::v4:
      return "x86-64-v4";
    case X86Level::v3:
      return "x86-64-v3";
    case X86Level::v2:
      return "x86-64-v2";
    case X86Level::v1:
      return "x86-64";
    case X86Level::none:
      break;
  }
#if defined(__aarch64__)
  return "aarch64";
#else
  return "unknown";
#endif
}

}  // namespace grainstep
