/// @file Which build this is.
#pragma once

#include <string>

namespace grainstep::orchestrator {

struct BuildInfo {
  std::string version;
  std::string commit;    ///< of the sources, with "+" where they were changed; "unknown" outside a repository
  std::string compiler;  ///< name and version
  std::string isa;       ///< the highest x86-64 level of the machine that we run on, or its architecture
};

[[nodiscard]] const BuildInfo& build_info();

}  // namespace grainstep::orchestrator
