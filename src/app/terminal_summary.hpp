#pragma once
// What the terminal says of a scene and of a run.

#include "observe/run_report.hpp"

#include <carom/scene.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
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

/// Lines of "  disks      64 of radius 0.03 ...": disks, box, collisions, effects, run. Ends with a newline.
std::string describe(const Scene& scene);

/// Samples from 0 to the end of the run, both included; empty where their number is not known beforehand.
std::optional<std::uint64_t> expected_samples(const Scene& scene);

}  // namespace carom::cli
