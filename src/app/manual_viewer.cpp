#include "app/manual_viewer.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

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
  std::filesystem::create_directories(directory);
  for (const ManualPage& page : pages) {
    const std::filesystem::path path = std::filesystem::path(directory) / page.file;
    std::ofstream file(path, std::ios::binary);
    file << page.text;
    file.close();
    if (!file) throw UsageError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
  }
  return exit_done;
}

}  // namespace carom::cli
