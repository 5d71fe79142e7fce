#pragma once
// The numbers of a summary.json by name, "pressure.Z": what can be averaged over seeds. What a clock measured is none of them.

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

struct SummaryNumber {
  std::string name;             ///< keys joined by dots, entries of lists numbered from 0; "observables.temperature.kT"
  std::optional<double> value;  ///< absent where the summary has null
};

/// In the order of the summary. An observable has its value under its name, and its standard error within the run under the name
/// with "_error".
[[nodiscard]] std::vector<SummaryNumber> numbers_of(const nlohmann::ordered_json& summary);

/// Whether a sweep's table holds the number where nothing else is asked for.
[[nodiscard]] bool is_usual_number(std::string_view name);

/// What is wrong with the name where no run can have such a number, as the end of a sentence; else empty. Names of observables'
/// numbers are known only when they have been measured.
[[nodiscard]] std::string fault_of_number_name(const std::string& name);

}  // namespace carom
