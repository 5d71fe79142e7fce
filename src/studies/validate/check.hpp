#pragma once
// One statement of theory or of the literature, what was measured, and whether the two agree.

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// A number that was measured, and its standard error.
struct Measured {
  double value = 0.0;
  double error = 0.0;
  /// Degrees of freedom of `error`: one less than the number of values whose scatter it is. Infinite where that is large.
  double freedom = std::numeric_limits<double>::infinity();
};

/// The purpose of a check.
enum class Judged {
  agrees,     ///< the measured number must agree with the expected one
  disagrees,  ///< negative control: the measured number must not agree, or the test could not tell a right law from a wrong one
  shown       ///< a comparison with an approximate theory, or of an approximate method; no verdict depends on it
};

struct Check {
  std::string name = {};
  std::string theory = {};  ///< the formula, in words
  std::string source = {};  ///< source of the theory
  double expected = 0.0;
  Measured measured = {};
  double reference_error = 0.0;    ///< standard error of `expected`, where that is a measured number of the literature
  double allowance = 0.0;          ///< bound on the error of the theory itself
  std::string allowance_for = {};  ///< which error of the theory that is
  /// Whether the measurement's error is an upper bound: of two numbers of one run, put together as if they were independent.
  bool error_is_bound = false;
  /// The deviation in standard errors, where it is not the difference over the error: a test whose statistic is not normal.
  std::optional<double> equivalent = {};
  Judged judged = Judged::agrees;
  /// The largest standard error with which the check still says what it claims; a larger one fails it. 0: any will do.
  double largest_error = 0.0;

  /// Returns the standard error of measured - expected: that of both.
  [[nodiscard]] double error() const;
  /// Returns the degrees of freedom of error() (Welch 1947, Satterthwaite 1946), where the reference's error is well known.
  [[nodiscard]] double freedom() const;
  /// Returns (measured - expected) / error(), without any allowance; infinite where they differ and there is no error, or where
  /// one of them is no number. An error of few degrees of freedom makes it Student's t, and this returns the normal deviate of
  /// the same probability. Of a calibrated measurement against an exact theory this is a normal variable of variance 1.
  [[nodiscard]] double z() const;
  /// Returns the deviation beyond the allowance, in standard errors, with the sign of z(); the verdict depends on it.
  [[nodiscard]] double deviation() const;
  /// Returns whether deviation() is within five standard errors, which chance exceeds once in 1.7 million.
  [[nodiscard]] bool fits() const;
  /// Returns whether z() is that of the measurement alone: a normal statistic that must agree, with an error of its own that is
  /// no bound, of which the errors of reference and theory together are less than a fifth.
  [[nodiscard]] bool calibrates() const;
  /// Returns whether the error is too large for the claim, or no number where there is to be one.
  [[nodiscard]] bool too_uncertain() const;
  /// Returns whether fits() is what it must be, and the check is not too_uncertain().
  [[nodiscard]] bool holds() const;
};

/// Numbers for a plot of the report.
struct Curve {
  std::string plot = {};  ///< the plot's id
  std::string name = {};
  bool theory = false;  ///< a line; else points
  std::vector<double> x = {}, y = {};
  std::vector<double> error = {};  ///< errors of y; empty, or as long
};

/// The results of one trial.
struct TrialResult {
  std::string trial = {};
  std::vector<Check> checks = {};
  std::vector<Curve> curves = {};
  std::vector<std::string> scenes = {};  ///< scene files of the runs
  double seconds = 0.0;
};

}  // namespace carom
