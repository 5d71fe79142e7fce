#pragma once
// Means at all lags of a run, and what observables of the motion of disks share.

#include "observe/blocking.hpp"
#include "observe/lagged_states.hpp"
#include "observe/tracked_disks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom {

/// A Blocking for each lag, as far as there are pairs.
class LaggedRows {
 public:
  void add(std::size_t row, double x, double weight = 1.0) {
    if (row >= rows_.size()) rows_.resize(row + 1);
    rows_[row].add(x, weight);
  }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] std::optional<Blocking::Estimate> estimate(std::size_t row, int power = 1) const {
    return rows_[row].estimate(power);
  }
  [[nodiscard]] std::optional<Blocking::Estimate> estimate_of_variance(std::size_t row) const {
    return rows_[row].estimate_of_variance();
  }
  [[nodiscard]] std::optional<Halves> halves(std::size_t row, int power = 1) const { return rows_[row].halves(power); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows_);
  }

 private:
  std::vector<Blocking> rows_;
};

/// A column and that of its errors.
struct LaggedColumn {
  Column values, errors;
  ColumnComparison comparison;

  LaggedColumn(const std::string& name, const std::string& unit, double most_error = most_error_of_halves)
      : values{name, unit, {}}, errors{name + "_error", unit, {}}, comparison(most_error) {}
  void add(const std::optional<Blocking::Estimate>& found, double factor = 1.0, double offset = 0.0) {
    if (found) lower_bounds_.add(*found);
    values.values.push_back(found ? offset + factor * found->mean : unknown);
    errors.values.push_back(found && found->error ? factor * *found->error : unknown);
  }
  /// Adds a row of a table, and compares its halves.
  void add(const LaggedRows& rows, std::size_t row, int power = 1, double factor = 1.0, double offset = 0.0) {
    add(rows.estimate(row, power), factor, offset);
    comparison.add(rows.halves(row, power), factor, offset);
  }
  /// Adds both columns to a table. Returns whether many of the errors are lower bounds.
  [[nodiscard]] bool put(Table& table) {
    comparison.put(table, values.name);
    table.columns.push_back(std::move(values));
    table.columns.push_back(std::move(errors));
    return lower_bounds_.are_many();
  }

 private:
  LowerBounds lower_bounds_;
};

/// Returns the column of lags of the rows from `first` on, below `end`.
[[nodiscard]] inline Column lag_column(std::size_t first, std::size_t end, double step) {
  Column lags{"lag", "time", {}};
  for (std::size_t row = first; row < end; ++row) lags.values.push_back(step * LaggedStates::lag(row));
  return lags;
}

/// Returns at how many moments between two redraws, `rate` of which come at equal steps in a unit of time, the pairs of states of
/// a lag lie; 0 for sixteen or more, whose mean is that over time to a hundredth.
inline int moments_between_redraws(double step, double rate) {
  constexpr int many = 16;
  for (int moments = 1; moments < many; ++moments) {
    const double redraws = moments * static_cast<double>(LaggedStates::apart) * step * rate;
    if (std::abs(redraws - std::nearbyint(redraws)) <= 1e-9 * redraws) return moments;
  }
  return 0;
}

/// Notes where all pairs of states of a lag lie at the same few moments between two redraws of [brownian]: at lags of few redraws
/// their mean is not that over time.
inline void note_moments(Measurement& found, const ObservedRun& run, double step) {
  const auto& brownian = run.scene.effects.brownian;
  constexpr double few = 8.0;  // redraws
  if (!brownian || !(brownian->rate > 0.0) || step * brownian->rate > few) return;
  const int moments = moments_between_redraws(step, brownian->rate);
  if (moments == 0) return;
  double better = 0.93 * step;
  while (moments_between_redraws(better, brownian->rate) > 0) better *= 0.99;
  if (!found.note.empty()) found.note += "; ";
  found.note += fmt::format(
      "at lags of few redraws of [brownian] this is no mean over time: states lie at {} between two of them; take every = {:.4g}",
      moments == 1 ? "one moment" : fmt::format("{} moments", moments), better);
}

/// The disks that are followed, by species, and where they were.
class DisksAtLags {
 public:
  DisksAtLags(const ObservableRequest& request, const ObservedRun& run) {
    for (std::size_t s = 0; s < run.species_count(); ++s) species_.emplace_back(request, run, s);
  }

  /// The number of coordinates that are followed of a species, two for each disk.
  [[nodiscard]] std::size_t channels(std::size_t species) const { return species_[species].disks.channels(); }
  /// Takes the state of the next step, and calls visit(species, row, displacements) for each lag, with x and y for each disk in
  /// turn. `drift` is the displacement of the centre of mass.
  template <class Visit>
  void add(const ObservedRun& run, const State& state, const Eigen::Vector2d& drift, Visit&& visit) {
    for (std::size_t s = 0; s < species_.size(); ++s) {
      Species& one = species_[s];
      if (one.disks.channels() == 0) continue;
      const std::span<const double> now = one.disks.unwrapped(run, state, drift);
      std::vector<double> moved(now.size());
      one.states.add(now, [&](std::size_t row, std::span<const double> earlier) {
        for (std::size_t c = 0; c < moved.size(); ++c) moved[c] = now[c] - earlier[c];
        visit(s, row, std::span<const double>(moved));
      });
    }
  }

  template <class Archive>
  void serialize(Archive& archive) {
    for (Species& one : species_) archive(one.states);
  }

 private:
  struct Species {
    TrackedDisks disks;
    LaggedStates states;
    Species(const ObservableRequest& request, const ObservedRun& run, std::size_t species)
        : disks(request, run, species), states(disks.channels()) {}
  };

  std::vector<Species> species_;
};

}  // namespace carom
