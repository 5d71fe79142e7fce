#pragma once
// What theory says of the numbers of a sweep, point by point (theory/run_theory.hpp).

#include "studies/sweep/results.hpp"
#include "studies/sweep/sweep.hpp"
#include "theory/run_theory.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace carom {

class SweepTheory {
 public:
  /// Requires that the sweep outlives this object. Theories need the mean temperature of the finished runs of a point. There is
  /// none for a sweep of so many points that to read their scenes again takes long.
  SweepTheory(const Sweep& sweep, const SweepResults& results);
  ~SweepTheory();
  SweepTheory(const SweepTheory&) = delete;
  SweepTheory& operator=(const SweepTheory&) = delete;

  /// Returns the value at a point of a number by its name in the results, "pressure.Z", "observables.viscosity.green_kubo" or
  /// "observables.mean_square_displacement.diffusion@5".
  [[nodiscard]] std::optional<Expected> of(std::size_t point, const std::string& number) const;

 private:
  struct Point;
  std::vector<std::unique_ptr<Point>> points_;
};

}  // namespace carom
