#pragma once
// All that a finished run says of itself, for a page about it: its summary, and from its trajectory, where it kept one, the scene
// and what was observed. Positions and velocities are RunReader's.

#include "io/output_error.hpp"
#include "observe/run_report.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>
#include <carom/version.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carom {

struct RunRecord {
  RunReport report;  ///< the report in summary.json; tables of observables are those of the trajectory
  BuildInfo build;   ///< the program that ran
  std::string command_line;

  /// The scene, and what only the trajectory holds; empty without a trajectory.
  struct Source {
    Scene scene;                         ///< box, effects, [run] and [observe]; for species see `disks`
    Disks disks;                         ///< empty where the scene's start file is gone, and there is no trajectory
    std::vector<std::string> species;    ///< names
    std::string resolved;                ///< the scene with every default
    std::string text;                    ///< the scene as it was written
    std::vector<std::string> overrides;  ///< options of the command line that change the scene
    std::uint64_t samples = 0, events = 0;
    std::vector<double> times;    ///< times of samples, thinned to a thousand at most
    std::vector<Column> sampled;  ///< "temperature", "kinetic_energy", ... at these times
  };
  bool has_trajectory = false;
  std::optional<Source> source;  ///< empty where neither file has the scene: earlier versions kept it in the trajectory alone
};

/// Throws OutputError: one sentence about a directory that is no finished run, or a file of it that cannot be read.
[[nodiscard]] RunRecord read_run_record(const std::filesystem::path& directory);

}  // namespace carom
