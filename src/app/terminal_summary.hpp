#pragma once
// What a run has shown, for the person who started it.

#include "observe/run_report.hpp"

#include <carom/scene.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace carom::cli {

/// Where the results of a run are, and how to name the program in suggestions.
struct Results {
  std::filesystem::path directory;
  std::vector<std::string> files;
  std::string program;
};

std::string terminal_summary(const RunReport& report, const Scene& scene, const Results& results);

}  // namespace carom::cli
