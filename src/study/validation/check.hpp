#pragma once
// One statement of theory or of the literature, what was measured, and whether the two agree.

#include <optional>
#include <string>
#include <vector>

namespace carom {

/// A number that was measured, and its standard error.
struct Measured {
  double value = 0.0;
  double error = 0.0;
};

/// What a check is for.
enum class Judged {
  agrees,     ///< what is measured is to agree with theory
  disagrees,  ///< a negative control: a law that must not be found here, or the test could not tell it from the right one
  shown       ///< what a method makes of it; no verdict depends on that
};

struct Check {
  std::string name = {};
  std::string theory = {};  ///< the formula, in words
  std::string source = {};  ///< who says so
  double expected = 0.0;
  Measured measured = {};
  double allowance = 0.0;          ///< how far theory itself may be off
  std::string allowance_for = {};  ///< why
  /// In standard errors, where it is not the difference over the error: a test whose statistic is not normal.
  std::optional<double> equivalent = {};
  Judged judged = Judged::agrees;

  /// What is beyond the allowance, in standard errors; with a sign where it has one.
  [[nodiscard]] double deviation() const;
  /// Within five standard errors: chance is farther off once in 1.7 million.
  [[nodiscard]] bool fits() const;
  /// Whether it is as it must be.
  [[nodiscard]] bool holds() const;
};

/// Numbers for a plot of the report.
struct Curve {
  std::string plot = {};  ///< the plot's id
  std::string name = {};
  bool theory = false;  ///< a line; else points
  std::vector<double> x = {}, y = {};
  std::vector<double> error = {};  ///< of y; empty, or as long
};

/// What one trial has found.
struct TrialResult {
  std::string trial = {};
  std::vector<Check> checks = {};
  std::vector<Curve> curves = {};
  std::vector<std::string> scenes = {};  ///< what was run, as scene files
  double seconds = 0.0;
};

}  // namespace carom
