#include "terminal/observed_lines.hpp"

#include "text/numbers.hpp"
#include "text/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

std::string heading(const Measurement& measured, const Scene& scene) {
  const auto request = std::find_if(scene.observe.begin(), scene.observe.end(),
                                    [&](const ObservableRequest& one) { return one.name == measured.name; });
  const bool stepped = request != scene.observe.end() && request->every;
  return measured.name + (stepped ? fmt::format(", every {:.6g}", *request->every) : "") + "\n";
}

}  // namespace

std::string number_words(const Scalar& scalar) {
  const double error = scalar.error.value_or(0.0);
  const bool scatters = error > 1e-13 * std::abs(*scalar.value);
  return scatters ? with_error(*scalar.value, error) : fmt::format("{:.5g}", *scalar.value);
}

std::string observed_lines(const std::vector<Measurement>& observables, const Scene& scene) {
  std::string text;
  for (const Measurement& measured : observables) {
    text += heading(measured, scene);
    if (!measured.note.empty()) text += fmt::format("  {}\n", measured.note);
    TerminalTable table("lll");
    for (const Scalar& scalar : measured.scalars) {
      if (!scalar.value) table.add({scalar.name, scalar.note});
      if (scalar.value && scalar.unit.empty()) table.add({scalar.name, number_words(scalar)});
      if (scalar.value && !scalar.unit.empty())
        table.add({scalar.name, number_words(scalar), fmt::format("({})", unit_words(scalar.unit))});
    }
    for (const Table& one : measured.tables) {
      const std::size_t rows = one.columns.empty() ? 0 : one.columns.front().values.size();
      table.add({one.name, "a table of " + counted(rows, "row")});
    }
    text += table.text();
  }
  return text;
}

}  // namespace carom
