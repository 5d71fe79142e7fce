#pragma once
// Version and build of Carom, which every result file records.

#include <string>

namespace carom {

/// Facts about the build of this library.
struct BuildInfo {
  std::string version;   ///< "0.2.0"
  std::string commit;    ///< git commit, with "-dirty" if the sources were changed; "unknown" outside a checkout
  std::string compiler;  ///< "GNU 12.2.0"
  std::string flags;     ///< the compiler flags of this build, with its build type
};

/// Returns the facts about this build.
const BuildInfo& build_info();

}  // namespace carom
