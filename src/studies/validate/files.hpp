#pragma once
// A validation in files: trials.jsonl, which grows by a line with every finished trial and from which an interrupted validation
// goes on; validation.json with everything; the page.

#include "studies/finished_parts.hpp"
#include "studies/validate/validation.hpp"

#include <carom/pages/page.hpp>

#include <filesystem>
#include <string>

namespace carom {

/// Returns the key that two validations must share for one to continue the other: the amount of work, the seed, the program.
[[nodiscard]] std::string validation_key(const ValidateOptions& options);

/// The finished trials, one JSON object a line.
class TrialsFile {
 public:
  /// Begins a new file with the trials of `before`. Throws OutputError.
  TrialsFile(std::filesystem::path path, const std::string& key, const Validation& before);
  void add(const TrialResult& result);

 private:
  detail::FinishedParts parts_;
};

/// Returns the trials that an earlier validation has finished. A last line that was not finished is left out. Throws OutputError
/// where the file cannot be read, or belongs to another validation than `key`.
[[nodiscard]] Validation load_trials(const std::filesystem::path& path, const std::string& key);

[[nodiscard]] std::string validation_json(const Validation& validation, const std::string& command_line);

Page validation_page(const Validation& validation, const std::string& command_line);

}  // namespace carom
