#include "orchestrator/record/build_info.hpp"

#include "base/instruction_set.hpp"
#include "orchestrator_commit.hpp"

namespace grainstep::orchestrator {

const BuildInfo& build_info() {
  static const BuildInfo info {
    .version = GRAINSTEP_VERSION, .commit = GRAINSTEP_COMMIT,
#if defined(__clang__)
    .compiler = "Clang " __clang_version__,
#else
    .compiler = "GCC " __VERSION__,
#endif
    .isa = instruction_set_name()
  };
  return info;
}

}  // namespace grainstep::orchestrator
