#pragma once
// The results of a sweep, from the files of its runs alone and in the order of its points: they do not depend on the number of
// threads or processes.

#include "studies/sweep/state.hpp"
#include "studies/sweep/sweep.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// Over the seeds of a point that have the number.
struct SeedAverage {
  std::size_t count = 0;
  std::optional<double> mean;
  std::optional<double> error;  ///< standard error, s / sqrt(count) with s^2 = sum (x - mean)^2 / (count - 1); absent for one
};
[[nodiscard]] SeedAverage average_of(const std::vector<std::optional<double>>& values);

struct SweepResults {
  std::vector<std::string> numbers;  ///< the columns
  std::vector<std::string> units;    ///< unit of each column, made of the scene's units; empty for a pure number
  std::vector<FoundRun> runs;        ///< state of every run; `numbers` is empty
  std::vector<std::vector<std::optional<double>>> values;  ///< values of every run, one per column
  std::vector<std::vector<SeedAverage>> averages;          ///< averages of every point, one per column
  std::vector<std::string> versions;                       ///< the programs that have run it; one, or the runs are of several

  /// Returns the number of runs of a point in this state.
  [[nodiscard]] std::size_t count(const Sweep& sweep, std::size_t point, RunState state) const;
  [[nodiscard]] std::size_t count(RunState state) const;
};

/// Reads what is below `directory`.
[[nodiscard]] SweepResults collect(const Sweep& sweep, const std::filesystem::path& directory);

}  // namespace carom
