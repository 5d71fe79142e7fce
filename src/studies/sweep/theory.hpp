#pragma once
// What theory says of the numbers of a sweep, point by point (theory/run_theory.hpp).

#include "studies/sweep/results.hpp"
#include "studies/sweep/sweep.hpp"
#include "theory/run_theory.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// Returns whether two curves are the same but for rounding.
[[nodiscard]] bool same_curve(const TheoryCurve& one, const TheoryCurve& other);

class SweepTheory {
 public:
  /// Requires that sweep and results outlive this object. Theories need the mean temperature of the finished runs of a point.
  /// There is none for a sweep of so many points that to read their scenes again takes long.
  SweepTheory(const Sweep& sweep, const SweepResults& results);
  ~SweepTheory();
  SweepTheory(const SweepTheory&) = delete;
  SweepTheory& operator=(const SweepTheory&) = delete;

  /// Returns the value at a point of a number by its name in the results, "pressure.Z", "observables.viscosity.green_kubo" or
  /// "observables.mean_square_displacement.diffusion@5".
  [[nodiscard]] std::optional<Expected> of(std::size_t point, const std::string& number) const;

  /// Returns the lines that belong to a column of a table of a point, which is a mean over its runs; a value that the column
  /// comes to is a level one. Empty where they differ from run to run, as they do with the temperature or with radii that are
  /// drawn.
  [[nodiscard]] std::vector<TheoryCurve> curves(std::size_t point, const Table& table, const std::string& column);

 private:
  struct Point;
  [[nodiscard]] const std::vector<std::unique_ptr<Point>>& runs_of(std::size_t point);

  const Sweep& sweep_;
  const SweepResults& results_;
  std::vector<std::unique_ptr<Point>> points_;
  std::map<std::size_t, std::vector<std::unique_ptr<Point>>> runs_;  ///< of points that have been asked for, each by itself
};

}  // namespace carom
