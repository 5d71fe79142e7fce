#pragma once
// The summary of a run on the terminal.

#include "observe/run_report.hpp"

#include <carom/scene.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace carom::cli {

/// The directory and files of the results of a run, and the program's name for suggestions.
struct Results {
  std::filesystem::path directory;
  std::vector<std::string> files;
  std::string program;
};

std::string terminal_summary(const RunReport& report, const Scene& scene, const Results& results);

}  // namespace carom::cli
