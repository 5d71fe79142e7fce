#pragma once
// Which Carom this is: the facts that every result file carries.

#include <string>

namespace carom {

struct BuildInfo {
  std::string version;   ///< "0.1.0"
  std::string commit;    ///< git commit, with "-dirty" where the tree was changed; "unknown" outside a checkout
  std::string compiler;  ///< "GNU 12.2.0"
  std::string flags;     ///< the compiler flags of this build, with its build type
};

const BuildInfo& build_info();

}  // namespace carom
