#include "app/manual_viewer.hpp"

#include "terminal/output_paths.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

namespace carom::cli {

ExitCode show_manual_page(const std::string& text) {
  if (isatty(STDOUT_FILENO) != 0 && access("/usr/bin/man", X_OK) == 0) {
    if (std::FILE* viewer = popen("/usr/bin/man --local-file -", "w")) {
      std::fwrite(text.data(), 1, text.size(), viewer);
      if (pclose(viewer) == 0) return exit_done;
    }
  }
  fmt::print("{}", text);
  return exit_done;
}

ExitCode write_manual_pages(const std::string& directory, const std::vector<ManualPage>& pages) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw UsageError(fmt::format("{}: this directory cannot be made: {}", directory, error.message()));
  for (const ManualPage& page : pages) write_whole_file(std::filesystem::path(directory) / page.file, page.text);
  return exit_done;
}

}  // namespace carom::cli
