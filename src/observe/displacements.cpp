// Distribution of the displacements at a lag, the self part of van Hove's function: P(r,t) = 2 pi r G_s(r,t), whose integral over
// r is 1. And how far it is from a Gaussian: alpha_2(t) = <r^4> / (2 <r^2>^2) - 1, which is -1/N as long as N disks of total
// momentum 0 fly freely. Averages over time. Motion of the centre of mass is left out.

#include "observe/lagged_rows.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

namespace {

/// The relative error up to which 1 + alpha_2 can be compared with itself. Of n Gaussian displacements it is 1 / sqrt(n), and the
/// skewness that of the mean of x^2 / 2 - 2 x, x = r^2 / <r^2>: 10 / sqrt(n), 0.1 as that of squares at most_error_of_halves.
constexpr double most_error_of_fourth = 0.01;

class NonGaussian final : public SavedObservable<NonGaussian> {
 public:
  NonGaussian(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run), followed_(request, run), fourth_(run.species_count()) {}

  void sample(const State& state, const Totals&) override {
    const Eigen::Vector2d drift = non_thermal_displacement(run_, state);
    followed_.add(run_, state, drift, [&](std::size_t s, std::size_t row, std::span<const double> moved) {
      double square = 0.0, fourth = 0.0;
      for (std::size_t c = 0; c < moved.size(); c += 2) {
        const double one = moved[c] * moved[c] + moved[c + 1] * moved[c + 1];
        square += one, fourth += one * one;
      }
      const double count = 0.5 * static_cast<double>(moved.size());
      fourth_[s].add(row, fourth / count, square / count);
    });
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    Table table{.name = name()};
    bool some_are_bounds = false;
    for (std::size_t s = 0; s < run_.species_count(); ++s) {
      if (fourth_[s].size() < 2) continue;
      if (table.columns.empty()) table.columns.push_back(lag_column(1, fourth_[s].size(), step_));
      LaggedColumn alpha("alpha_2" + run_.suffix(s), "", most_error_of_fourth);
      for (std::size_t row = 1; row < fourth_[s].size(); ++row) alpha.add(fourth_[s], row, 2, 0.5, -1.0);
      some_are_bounds = alpha.put(table) || some_are_bounds;
    }
    note_lower_bounds(found, some_are_bounds);
    note_moments(found, run_, step_);
    put_table(found, std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(followed_, fourth_);
  }

 private:
  DisksAtLags followed_;
  std::vector<LaggedRows> fourth_;  ///< by species: of r^4 with r^2 as its weight
};

class VanHove final : public SavedObservable<VanHove> {
 public:
  VanHove(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        followed_(request, run),
        bins_(static_cast<std::size_t>(request.bins.value_or(100))),
        width_(request.range.value_or(5.0) * run.mean_diameter / static_cast<double>(bins_)),
        densities_(run.species_count()) {}

  void sample(const State& state, const Totals&) override {
    const Eigen::Vector2d drift = non_thermal_displacement(run_, state);
    followed_.add(run_, state, drift, [&](std::size_t s, std::size_t row, std::span<const double> moved) {
      if (row == 0) return;
      const int power = std::ilogb(LaggedStates::lag(row));
      if (std::ldexp(1.0, power) != LaggedStates::lag(row)) return;
      std::vector<double> counts(bins_);
      for (std::size_t c = 0; c < moved.size(); c += 2)
        if (const double bin = std::hypot(moved[c], moved[c + 1]) / width_; bin < static_cast<double>(bins_))
          counts[static_cast<std::size_t>(bin)] += 1.0;
      const auto at = static_cast<std::size_t>(power);
      if (at >= densities_[s].size()) densities_[s].resize(at + 1, BlockedColumn(bins_));
      const double count = 0.5 * static_cast<double>(moved.size());
      for (std::size_t b = 0; b < bins_; ++b) densities_[s][at].add(b, counts[b] / count);
    });
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    Table table{.name = name()};
    table.columns.push_back({"r", "length", {}});
    for (std::size_t b = 0; b < bins_; ++b) table.columns[0].values.push_back((static_cast<double>(b) + 0.5) * width_);
    for (std::size_t s = 0; s < run_.species_count(); ++s)
      for (std::size_t at = 0; at < densities_[s].size(); ++at)
        densities_[s][at].put(table, fmt::format("density{}_{:.6g}", run_.suffix(s), std::ldexp(step_, static_cast<int>(at))),
                              "1 / length", 1.0 / width_);
    note_lower_bounds(found, std::ranges::any_of(densities_, [](const std::vector<BlockedColumn>& of_species) {
                        return std::ranges::any_of(of_species, &BlockedColumn::has_lower_bounds);
                      }));
    note_moments(found, run_, step_);
    put_table(found, std::move(table), 1);
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(followed_, densities_);
  }

 private:
  DisksAtLags followed_;
  std::size_t bins_;
  double width_;
  std::vector<std::vector<BlockedColumn>> densities_;  ///< by species, and by the lag's power of two
};

}  // namespace

MadeObservable make_non_gaussian(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<NonGaussian>(request, run);
}

MadeObservable make_van_hove(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<VanHove>(request, run);
}

}  // namespace carom
