#include "base/instruction_set.hpp"
#include "dem-service/native/sweeps.hpp"

namespace grainstep::dem::native {

// Defined by the copies of sweeps.cpp.
#if defined(__x86_64__) && !defined(GRAINSTEP_ONE_KERNEL)
extern const Sweeps sweeps_x86_64;
extern const Sweeps sweeps_x86_64_v3;
extern const Sweeps sweeps_x86_64_v4;
#else
extern const Sweeps sweeps_generic;
#endif

namespace {

std::vector<const Sweeps*> detect() {
  std::vector<const Sweeps*> found;
#if defined(__x86_64__) && !defined(GRAINSTEP_ONE_KERNEL)
  if (x86_level() >= X86Level::v4) found.push_back(&sweeps_x86_64_v4);
  if (x86_level() >= X86Level::v3) found.push_back(&sweeps_x86_64_v3);
  found.push_back(&sweeps_x86_64);
#else
  found.push_back(&sweeps_generic);
#endif
  return found;
}

}  // namespace

const std::vector<const Sweeps*>& available_sweeps() {
  static const std::vector<const Sweeps*> all = detect();
  return all;
}

}  // namespace grainstep::dem::native
