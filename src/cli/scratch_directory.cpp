#include "cli/scratch_directory.hpp"

#include "io/output_error.hpp"

#include <stdlib.h>  // mkdtemp is POSIX, not C++

#include <cerrno>
#include <string>
#include <system_error>

namespace carom::cli {

ScratchDirectory::ScratchDirectory() {
  std::string name = (std::filesystem::temp_directory_path() / "carom-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw detail::system_error(name, "make this directory", errno);
  path_ = name;
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace carom::cli
