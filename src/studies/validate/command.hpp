#pragma once
// carom validate: measurements held against known results.

#include "studies/validate/validation.hpp"
#include "terminal/command.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

struct ValidateCommandOptions {
  bool quick = false;  ///< the default, without --full
  bool full = false;
  std::int64_t seed = 1;
  std::vector<std::string> only;    ///< names of trials; empty: all
  std::optional<int> threads = {};  ///< number of trials at a time; empty: one per processor
  std::string out;                  ///< empty: validation
  bool list = false;
  bool force = false;
  bool resume = false;
  bool json = false;
  bool markdown = false;
  bool quiet = false;
  std::string progress = "auto";
};
/// Returns the validation that the options ask for. Throws UsageError where one of them is out of range.
[[nodiscard]] ValidateOptions validate_options(const ValidateCommandOptions& options);

ExitCode validate(const ValidateCommandOptions& options, const Invocation& invocation);

}  // namespace carom::cli
