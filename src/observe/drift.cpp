#include "observe/drift.hpp"

#include "observe/blocking.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace carom {

namespace {

/// The probability that a run in equilibrium has a remark on the Z of its summary, and that it has one on any number of its
/// observables: together 0.01. Where tables are compared too, half of the latter is for them: their many rows then do not raise
/// the threshold of the other numbers by more than that.
constexpr double false_alarms_of_Z = 0.001, false_alarms = 0.009;

std::string words_of(const Halves& halves, bool is_steady_expected) {
  return fmt::format("{}: {:.5g} in the first {:.0f} % of the samples and {:.5g} in the rest, {:.1f} standard errors apart",
                     is_steady_expected ? not_in_equilibrium : not_steady, halves.first, 100.0 * halves.share, halves.rest,
                     std::abs(halves.first - halves.rest) / halves.error);
}

void put_before(std::string& note, const std::string& words) { note = note.empty() ? words : fmt::format("{}; {}", words, note); }

/// Returns the column of the measurement's tables whose halves differ the most; null where none can be compared.
struct MostDifferent {
  const Table* table = nullptr;
  const ColumnHalves* column = nullptr;
};
MostDifferent most_different(const Measurement& measured) {
  MostDifferent most;
  for (const Table& table : measured.tables)
    for (const ColumnHalves& column : table.halves)
      if (most.column == nullptr || column.halves.probability < most.column->halves.probability) most = {&table, &column};
  return most;
}

/// Returns the place of the row: "r = 1.5", or "x = 0.25, y = 2.5".
std::string place_of(const ColumnHalves& column, const Table& table) {
  std::string words;
  for (std::size_t axis = 0; axis < column.at.size(); ++axis)
    words += fmt::format("{}{} = {:.5g}", axis == 0 ? "" : ", ", table.columns[axis].name, column.at[axis]);
  return words;
}

bool says_drift(const std::string& note) { return says_not_in_equilibrium(note) || note.find(not_steady) != std::string::npos; }

/// Whether gravity does work on and on: along a periodic axis.
bool falls_for_ever(const Scene& scene) {
  const Eigen::Vector2d g = scene.effects.acceleration();
  return (scene.box.periodic(0) && g[0] != 0.0) || (scene.box.periodic(1) && g[1] != 0.0);
}

/// Whether energy, room or the size of disks changes in one direction for the whole of a run: disks cool and nothing heats them,
/// they grow, or a wall moves on and on.
bool changes_throughout(const Scene& scene) {
  const Effects& effects = scene.effects;
  const auto heats = [](const WallProperties& wall) { return wall.temperature || wall.vibration || wall.oscillation; };
  const auto moves_on = [](const WallProperties& wall) { return wall.velocity.value_or(0.0) != 0.0; };
  const bool heated = effects.thermostat || effects.brownian || effects.tumbling || effects.shear || falls_for_ever(scene) ||
                      std::ranges::any_of(effects.walls, heats);
  const bool cools = (effects.dissipate() || effects.drag_rate() > 0.0) && !heated;
  return cools || effects.growth_rate() > 0.0 || std::ranges::any_of(effects.walls, moves_on);
}

/// A longer run would not make it longer than its correlations.
void say_change(Scalar& scalar) {
  if (const std::size_t at = scalar.note.find(too_short); at != std::string::npos)
    scalar.note.replace(at, too_short.size(), fmt::format("{}: a mean over a change", not_steady));
}

}  // namespace

void note_drifts(std::vector<Measurement>& measured, const Scene& scene) {
  const Effects& effects = scene.effects;
  std::size_t numbers = 0, rows = 0;
  for (const Measurement& one : measured) {
    for (const Scalar& scalar : one.scalars) numbers += scalar.halves ? 1U : 0U;
    for (const Table& table : one.tables)
      for (const ColumnHalves& column : table.halves) rows += column.compared;
  }
  const double share = rows > 0 && numbers > 0 ? 0.5 : 1.0;
  const auto is_chance = [&](const Halves& halves, std::size_t compared) {
    return halves.probability * static_cast<double>(compared) >= share * false_alarms;
  };
  const bool changing = changes_throughout(scene);
  const bool is_steady_expected = !effects.dissipate() && !(effects.drag_rate() > 0.0) && scene.changes.empty() && !changing;
  for (Measurement& one : measured) {
    for (Scalar& scalar : one.scalars) {
      if (changing) say_change(scalar);
      if (scalar.halves && !is_chance(*scalar.halves, numbers))
        put_before(scalar.note, words_of(*scalar.halves, is_steady_expected));
    }
    if (const MostDifferent most = most_different(one); most.column != nullptr && !is_chance(most.column->halves, rows))
      put_before(one.note, fmt::format("{} ({} at {})", words_of(most.column->halves, is_steady_expected), most.column->column,
                                       place_of(*most.column, *most.table)));
  }
}

std::string note_on_drift_of_Z(const std::optional<Halves>& halves) {
  return halves && halves->probability < false_alarms_of_Z ? words_of(*halves, true) : std::string();
}

std::vector<std::string> drifting_numbers(const std::vector<Measurement>& measured) {
  std::vector<std::string> names;
  for (const Measurement& one : measured) {
    for (const Scalar& scalar : one.scalars)
      if (says_drift(scalar.note)) names.push_back(fmt::format("{}.{}", one.name, scalar.name));
    if (says_drift(one.note)) names.push_back(fmt::format("{} (its table)", one.name));
  }
  return names;
}

bool says_not_in_equilibrium(std::string_view note) { return note.find(not_in_equilibrium) != std::string_view::npos; }

bool some_not_in_equilibrium(const std::vector<Measurement>& measured) {
  return std::ranges::any_of(measured, [](const Measurement& one) {
    return says_not_in_equilibrium(one.note) ||
           std::ranges::any_of(one.scalars, [](const Scalar& scalar) { return says_not_in_equilibrium(scalar.note); });
  });
}

std::string sentence_of_drifts(const std::vector<std::string>& names, bool in_equilibrium_expected) {
  return fmt::format("The first and the second half of the run differ by more than chance, so it was not {}: {}.",
                     in_equilibrium_expected ? "in equilibrium" : "steady", fmt::join(names, ", "));
}

}  // namespace carom
