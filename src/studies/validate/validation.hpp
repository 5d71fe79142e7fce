#pragma once
// carom validate: all trials, several at a time; what they found in words and in JSON.

#include "studies/validate/check.hpp"
#include "studies/validate/trial.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carom {

struct ValidateOptions {
  bool full = false;  ///< twenty times the collisions of a quick validation, and trials of its own
  std::uint64_t seed = 1;
  std::vector<std::string> only = {};  ///< names of trials and of groups; empty: all
  int threads = 0;                     ///< number of trials that run at a time; 0: as many as there are processors
};

struct Validation {
  ValidateOptions options = {};
  std::vector<TrialResult> results = {};  ///< results in the order of the trials
  bool complete = false;

  [[nodiscard]] std::size_t checks() const;
  [[nodiscard]] std::size_t failed() const;
};

struct ValidateHooks {
  /// Called by the thread that called validate(), with what is being done and the fraction of the trials that is done (0 to 1).
  /// Returning false stops the validation.
  std::function<bool(const std::string& doing, double fraction)> proceed = {};
  /// Called when a trial has ended, by the thread that ran it, one call at a time.
  std::function<void(const TrialResult& result)> done = {};
};

/// Returns the name of a group with hyphens for blanks, as a shell completes it: "equation-of-state".
[[nodiscard]] std::string group_in_one_word(std::string group);

/// Returns the trials that `options` name; a group has its own name or that of one word. Throws std::invalid_argument where there
/// is no such trial and no such group.
[[nodiscard]] std::vector<validation::Trial> chosen_trials(const ValidateOptions& options);

/// Runs the trials that `before` does not hold already. A trial that cannot be run is one that fails. What a trial finds does not
/// depend on the number of threads.
[[nodiscard]] Validation validate(const ValidateOptions& options, const ValidateHooks& hooks, const Validation& before = {});

/// Returns the group of the trial whose results these are; an empty name where there is no such trial.
[[nodiscard]] std::string group_of(const TrialResult& result);

/// How well the trials of a group fit theory and literature together: the mean of z^2 over one check of each trial. The checks
/// are those of separate runs, so that for a right engine with right errors `trials` times that mean has the distribution of chi
/// squared.
struct GroupFit {
  std::string group = {};
  std::size_t trials = 0;          ///< trials that count: those with a check that calibrates
  double mean_square = 0.0;        ///< chi squared per trial
  double least = 0.0, most = 0.0;  ///< what `mean_square` lies between in 19 of 20 cases
};

/// Returns the fit of every group of at least five such trials. A trial's first check that Check::calibrates counts for it.
[[nodiscard]] std::vector<GroupFit> group_fits(const Validation& validation);

/// Returns text such as "chi squared per trial 0.93 (22 trials; 0.50 to 1.67 in 19 of 20 cases)"
[[nodiscard]] std::string sentence_of(const GroupFit& fit);

/// One check as people read it.
struct CheckRow {
  std::string name = {}, theory = {}, source = {};
  std::string expected = {};   ///< "2.0602"
  std::string measured = {};   ///< "2.0599 +- 0.0010", with the sign of plus or minus
  std::string z = {};          ///< "-0.3": the whole difference in standard errors; "exact", "not equal" where there is no error
  std::string per_cent = {};   ///< "-0.01 %" of what is expected; empty where that is 0 or no number
  std::string beyond = {};     ///< "-2.1": standard errors beyond the allowance; empty where there is no allowance
  std::string allowance = {};  ///< "0.02: why"; empty where there is none
  /// "agrees", "FAILS", "fails, as it must", "FITS, and must not", "consistent (not judged)", "differs (not judged)"
  std::string verdict = {};
};
[[nodiscard]] CheckRow row_of(const Check& check);

/// One check as a sentence: "Z of 256 disks: 2.0599 +- 0.0010, expected 2.0602; z = -0.3 (-0.01 %)"
[[nodiscard]] std::string sentence_of(const Check& check);

/// Returns text such as "98 checks in 40 trials: all hold"
[[nodiscard]] std::string summary_of(const Validation& validation);

/// Returns a table for each group.
[[nodiscard]] std::string validation_markdown(const Validation& validation);

}  // namespace carom
