// The facts of this build. CMakeLists.txt defines them for this file alone, so that a new commit recompiles nothing else.

#include <build_commit.hpp>
#include <carom/version.hpp>

namespace carom {

const BuildInfo& build_info() {
  static const BuildInfo info{.version = CAROM_VERSION, .commit = CAROM_COMMIT, .compiler = CAROM_COMPILER, .flags = CAROM_FLAGS};
  return info;
}

}  // namespace carom
