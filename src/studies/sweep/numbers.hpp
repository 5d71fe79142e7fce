#pragma once
// The numbers of a summary.json by name, "pressure.Z", which can be averaged over seeds, and the units of these and of the keys
// of a scene. Measurements of a clock are none of them.

#include <carom/scene.hpp>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// Returns the unit of a number of summary.json outside of `observables`, as in docs/output.md: "energy" for "energy.final";
/// empty for a pure number.
[[nodiscard]] std::string unit_of_number(std::string_view name);

/// Returns the unit of a key of the scene, as in docs/scene-format.md: "length" for "disks.0.radius"; empty for a pure number and
/// for words.
[[nodiscard]] std::string unit_of_key(std::string_view key);

struct SummaryNumber {
  std::string name;             ///< keys joined by dots, entries of lists numbered from 0; "observables.temperature.kT"
  std::optional<double> value;  ///< absent where the summary has null
  std::string unit = {};        ///< made of the scene's units; empty for a pure number
};

/// Returns all numbers in the order of the summary. The value of an observable has the observable's name, and its standard error
/// within the run the name with "_error".
[[nodiscard]] std::vector<SummaryNumber> numbers_of(const nlohmann::ordered_json& summary);

/// Returns the words of a line between its commas.
[[nodiscard]] std::vector<std::string> split_at_commas(const std::string& line);

/// A number out of a table of an observable: the value of a column where the first column has the value `at`, or in the cell of a
/// grid where the first columns have the values `at`.
struct TableNumber {
  std::string table;       ///< "mean_square_displacement"
  std::string column;      ///< "diffusion", "diffusion_error"
  std::vector<double> at;  ///< one or more, in the units of the table's first columns
};

/// Returns the parts of "observables.TABLE.COLUMN@VALUE" or "...@VALUE,VALUE"; nothing where the name is none of these or a VALUE
/// no finite number.
[[nodiscard]] std::optional<TableNumber> table_number(std::string_view name);

/// Returns whether a run of the scene may have the number, with a value or null: it is one of `numbers`, which number_names()
/// returned for this scene, or a column of one of their tables. A lag must not be longer than the run, the place of a cell must
/// be in the box unless its walls move, a number of neighbours must be whole, and a curve over a length, a wave number, a
/// size or, at a temperature that the scene says, a speed must begin and end around the value.
[[nodiscard]] bool has_number(const std::string& name, const Scene& scene, const std::vector<std::string>& numbers);

/// Returns whether a sweep's table holds the number where nothing else is asked for.
[[nodiscard]] bool is_usual_number(std::string_view name);

/// Returns the names of all numbers that a run of the scene has in its summary, with a value or null; and after them
/// "observables.TABLE.COLUMN@FIRST" for each column of the tables of its observables but those that say which row it is, where
/// FIRST is the name of the table's first column, or "x,y" where its rows are cells of a grid. Nothing is drawn and nothing run.
[[nodiscard]] std::vector<std::string> number_names(const Scene& scene);

/// Returns the end of a sentence that says why `name` is none of the numbers, and which there are.
[[nodiscard]] std::string fault_of_number_name(const std::string& name, const std::vector<std::string>& numbers);

}  // namespace carom
