#pragma once
// The speeds of all disks in whole snapshots of one run, held against a law for their distribution.

#include "studies/validate/check.hpp"
#include "theory/microcanonical.hpp"

#include <carom/observe.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace carom::validation {

/// Counts of v^2 over its mean, in bins that the finite-N law makes equally likely. So many that what they hide of a distance is
/// far below what chance makes of it.
class SpeedCounts {
 public:
  explicit SpeedCounts(const theory::Microcanonical& law) : law_(law), counts_(bins) {}

  /// One snapshot.
  void add(const Eigen::Matrix2Xd& velocities);
  /// Returns sqrt(n) times the largest distance between the distribution of what was counted and that of the law itself.
  [[nodiscard]] double distance() const;
  /// Returns the distance from the law of infinitely many disks.
  [[nodiscard]] double distance_from_maxwell() const;
  /// Density of speeds, in 50 bins, with the errors of independent counts.
  [[nodiscard]] Curve density(const std::string& plot, const std::string& name) const;

 private:
  static constexpr std::size_t bins = std::size_t{1} << 20;
  [[nodiscard]] double distance_from(const std::function<double(double)>& below) const;

  theory::Microcanonical law_;
  std::vector<std::uint64_t> counts_;
  std::uint64_t total_ = 0;
  double mean_square_ = 0.0;
};

/// Counts the speeds at its steps.
class Snapshots final : public Observable {
 public:
  Snapshots(double step, SpeedCounts& counts) : step_(step), counts_(counts) {}
  [[nodiscard]] std::string name() const override { return "snapshots"; }
  [[nodiscard]] double step() const override { return step_; }
  void sample(const State& state, const Totals&) override { counts_.add(state.velocities); }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_;
  SpeedCounts& counts_;
};

/// The counts against the law.
[[nodiscard]] Check speed_check(const std::string& what, const SpeedCounts& counts);

/// Returns the line that belongs to density().
[[nodiscard]] Curve speed_curve(const std::string& plot, const theory::Microcanonical& law, double mean_square);

}  // namespace carom::validation
