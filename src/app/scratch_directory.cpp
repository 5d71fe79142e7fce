#include "app/scratch_directory.hpp"

#include "io/output_error.hpp"
#include "terminal/command.hpp"

#include <fmt/format.h>
#include <stdlib.h>  // mkdtemp is POSIX, not C++

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace carom::cli {

namespace {

namespace fs = std::filesystem;

fs::path place_for_temporary_files() {
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  if (!error) return place;
  for (const char* name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"})  // in the order in which the library looks
    if (const char* value = std::getenv(name))
      throw UsageError(
          fmt::format("{}={}: there is no such directory for temporary files; set {} to one that is there", name, value, name));
  throw UsageError("there is no directory for temporary files; set TMPDIR to one that is there");
}

}  // namespace

ScratchDirectory::ScratchDirectory() {
  std::string name = (place_for_temporary_files() / "carom-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw UsageError(detail::system_error(name, "make this directory", errno).what());
  path_ = name;
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace carom::cli
