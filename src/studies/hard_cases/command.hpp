#pragma once
// carom hardcases: the corpus of hard cases, in every engine.

#include "studies/hard_cases/hard_case.hpp"
#include "terminal/command.hpp"

#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

struct HardCasesOptions {
  std::vector<std::string> cases;  ///< names of the corpus or files; empty: all that do not take long
  std::string family;              ///< empty: all
  std::string engine = "auto";     ///< one engine alone
  bool takes_long = false;
  bool list = false;
  std::string show;  ///< the text of this case
  bool json = false;
  bool markdown = false;
  std::string page;          ///< an HTML file to write besides; empty: none
  std::string method;        ///< a fixed-step method in the place of the engines
  std::optional<double> dt;  ///< time step of the method; absent: from each case's speeds
};
/// Returns the named cases, however long they take; without names, the corpus. Throws UsageError where an option names none that
/// there is.
[[nodiscard]] std::vector<HardCase> chosen_cases(const HardCasesOptions& options);

ExitCode hardcases(const HardCasesOptions& options, const Invocation& invocation);

}  // namespace carom::cli
