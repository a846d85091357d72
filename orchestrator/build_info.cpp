#include "orchestrator/build_info.hpp"

#include "orchestrator_commit.hpp"

namespace grainstep::orchestrator {
namespace {

std::string machine() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  // The levels by what sets them apart; GCC knows them by name, Clang 14 does not.
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
    return "x86-64-v4";
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return "x86-64-v3";
  }
  return __builtin_cpu_supports("sse4.2") ? "x86-64-v2" : "x86-64";
#elif defined(__aarch64__)
  return "aarch64";
#else
  return "unknown";
#endif
}

}  // namespace

const BuildInfo& build_info() {
  static const BuildInfo info {
    .version = GRAINSTEP_VERSION, .commit = GRAINSTEP_COMMIT,
#if defined(__clang__)
    .compiler = "Clang " __clang_version__,
#else
    .compiler = "GCC " __VERSION__,
#endif
    .isa = machine()
  };
  return info;
}

}  // namespace grainstep::orchestrator
