#pragma once
// The results of a sweep, from the files of its runs alone and in the order of its points: they do not depend on the number of
// threads or processes. A run is finished exactly when its summary.json is there, of this very scene, and it was not interrupted;
// any other run is done again.

#include "studies/sweep/numbers.hpp"
#include "studies/sweep/sweep.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

enum class RunState {
  missing,  ///< not begun, begun and not finished, or interrupted
  finished,
  failed,
  other  ///< finished, with another scene
};
[[nodiscard]] std::string_view to_string(RunState state);

/// Holds the sentence of a run that has failed.
inline constexpr std::string_view failure_file = "failure.txt";
/// The scene of a run with every default, which the run reads.
inline constexpr std::string_view scene_file = "scene.toml";

struct FoundRun {
  RunState state = RunState::missing;
  std::string failure = {};                 ///< a sentence, of a run that has failed
  std::string stopped = {};                 ///< why it ended, of one that is finished
  std::string version = {};                 ///< and by which program: "0.1.0 (commit 1234567)"
  std::vector<SummaryNumber> numbers = {};  ///< its results
  std::optional<double> temperature = {};   ///< its mean kT, which theories need
};

/// `resolved` gives the scene of the run with every default; it is asked for only where there are results to hold it against.
[[nodiscard]] FoundRun find_run(const std::filesystem::path& directory, const std::function<std::string()>& resolved);

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
  std::vector<SeedAverage> temperatures;                   ///< mean kT of every point
  std::vector<std::string> versions;                       ///< the programs that have run it; one, or the runs are of several

  /// Returns the number of runs of a point in this state.
  [[nodiscard]] std::size_t count(const Sweep& sweep, std::size_t point, RunState state) const;
  [[nodiscard]] std::size_t count(RunState state) const;
};

/// Reads what is below `directory`. A number at a lag (table_number()) comes from the tables of the runs.
[[nodiscard]] SweepResults collect(const Sweep& sweep, const std::filesystem::path& directory);

/// Returns whether all values of this key are numbers.
[[nodiscard]] bool is_numeric(const Sweep& sweep, std::size_t key);
/// Returns a string without the quotes that TOML needs; other values as they are.
[[nodiscard]] std::string plain_value(const std::string& value);

/// Returns whether two numbers differ by more than rounding leaves: a part in 10^9 of the larger.
[[nodiscard]] bool differ(double a, double b);

/// Returns text such as "1.0970 ± 0.0041", "50", or a dash where there is none.
[[nodiscard]] std::string average_words(const SeedAverage& average);

}  // namespace carom
