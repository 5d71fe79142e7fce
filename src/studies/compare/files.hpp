#pragma once
// A comparison in files: points.jsonl, which grows by a line with every point that is finished and from which an interrupted
// study goes on; compare.json with everything; compare.csv with a line per run.

#include "studies/compare/compare.hpp"
#include "studies/compare/comparison.hpp"
#include "studies/finished_parts.hpp"

#include <carom/scene.hpp>

#include <filesystem>
#include <string>

namespace carom {

/// Returns the key that two studies must share for one to continue the other: the scene, the options that shape its points, and
/// the program.
[[nodiscard]] std::string study_key(const Scene& scene, const CompareOptions& options);

/// The finished points, one JSON object a line.
class PointsFile {
 public:
  /// Begins a new file with the points of `before`. Throws OutputError.
  PointsFile(std::filesystem::path path, const std::string& key, const Comparison& before);

  void add(const MethodRun& run);
  void add(const CostPoint& point);

 private:
  detail::FinishedParts parts_;
};

/// Returns the points that an earlier study has finished; its plan is made anew. A last line that was not finished is left out.
/// Throws OutputError where the file cannot be read, or belongs to another study than `key`.
[[nodiscard]] Comparison load_points(const std::filesystem::path& path, const std::string& key);

/// Everything, with the answers.
[[nodiscard]] std::string compare_json(const Comparison& comparison, const Scene& scene, const std::string& command_line);

/// Returns compare.csv: a line "method,dt,seed,..." per run.
[[nodiscard]] std::string compare_csv(const Comparison& comparison);

}  // namespace carom
