// Mean square displacement and what diffusion coefficient it amounts to at each lag: D(t) = <|r(t) - r(0)|^2> / 4 t. In two
// dimensions D grows with the logarithm of t, so there is no limit to report, but D at a lag of which the run holds many windows:
// the same one whatever its seed. Averages over time, of some disks of each species.

#include "observe/blocking.hpp"
#include "observe/equilibrium.hpp"
#include "observe/lagged_rows.hpp"
#include "observe/multiple_tau.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/tracked_disks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

namespace {

/// Fewer disks than this move together: the motion of each is correlated with that of all others through the centre of mass,
/// which is taken out. Measured with 8 (too large by 1.4) and 64 (right): see docs/observables.md.
constexpr std::size_t few = 32;

/// D is reported at the longest lag of which the run holds so many displacements along an axis, in windows side by side, whose
/// mean square chance alone leaves uncertain by 5 % (sqrt(2 / 800)); and so many of these windows, so that it has an error. Were
/// it the longest lag at which the error is small, chance would choose it.
constexpr double enough_displacements = 800.0, enough_windows = 8.0;

class MeanSquareDisplacement final : public SavedObservable<MeanSquareDisplacement> {
 public:
  MeanSquareDisplacement(const ObservableRequest& request, const ObservedRun& run) : SavedObservable(request, run) {
    for (std::size_t s = 0; s < run.species_count(); ++s) {
      tracked_.emplace_back(request, run, s);
      ladders_.emplace_back(tracked_.back().channels(), MultipleTau::Pairs::squared_differences);
    }
  }

  void sample(const State& state, const Totals&) override {
    const Eigen::Vector2d drift = non_thermal_displacement(run_, state);
    for (std::size_t s = 0; s < tracked_.size(); ++s)
      if (tracked_[s].channels() > 0) ladders_[s].add(tracked_[s].unwrapped(run_, state, drift));
  }

  [[nodiscard]] Measurement finish(double time, const Totals&) override {
    Measurement found{.name = name()};
    Table table{.name = name()};
    std::vector<MultipleTau::Row> all;
    for (std::size_t s = 0; s < ladders_.size(); ++s) {
      const std::vector<MultipleTau::Row> rows = ladders_[s].rows();
      if (tracked_[s].channels() > 0) found.scalars.push_back(diffusion_of(rows, s, time));
      if (rows.empty()) continue;
      all.insert(all.end(), rows.begin(), rows.end());
      const std::string suffix = run_.suffix(s);
      Column lags{"lag", "time", {}}, square{"msd" + suffix, "length^2", {}}, error{"msd" + suffix + "_error", "length^2", {}};
      Column diffusion{"diffusion" + suffix, "length^2 / time", {}},
          its_error{"diffusion" + suffix + "_error", "length^2 / time", {}};
      ColumnComparison comparison;
      for (const MultipleTau::Row& row : rows) {
        comparison.add(row.halves, 2.0);
        const double lag = step_ * row.lag, msd = 2.0 * row.pairs.mean;
        const double err = row.pairs.error ? 2.0 * *row.pairs.error : unknown;
        lags.values.push_back(lag);
        square.values.push_back(msd);
        error.values.push_back(err);
        diffusion.values.push_back(msd / (4.0 * lag));
        its_error.values.push_back(err / (4.0 * lag));
      }
      if (table.columns.empty()) table.columns.push_back(lags);
      comparison.put(table, square.name);
      for (Column* column : {&square, &error, &diffusion, &its_error}) table.columns.push_back(std::move(*column));
    }
    found.note = MultipleTau::note_on_errors(all);
    const auto add_note = [&](std::string_view sentence) {
      found.note += (found.note.empty() ? "" : "; ") + std::string(sentence);
    };
    const bool cover_starts = why_errors_are_of_one_start(run_.scene).empty();
    if (cover_starts && !(run_.scene.box.periodic(0) && run_.scene.box.periodic(1)))
      add_note("between walls errors at long lags are up to 1.3 times too large");
    for (int axis = 0; axis < 2; ++axis)
      if (run_.drifts_along(axis) && !run_.scene.box.periodic(1 - axis))
        add_note("disks drift with a flow that differs from place to place: only its mean is taken out");
    if (cover_starts && run_.disks.count() < few) add_note("errors of so few disks are up to 1.4 times too large");
    note_moments(found, run_, step_);
    put_table(found, std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(ladders_);
  }

 private:
  /// Returns the diffusion coefficient at the longest lag of which a run of this time holds enough displacements.
  [[nodiscard]] Scalar diffusion_of(const std::vector<MultipleTau::Row>& rows, std::size_t species, double time) const {
    Scalar scalar{.name = "diffusion" + run_.suffix(species), .unit = "length^2 / time"};
    const double channels = static_cast<double>(tracked_[species].channels());
    const auto holds_enough = [&](const MultipleTau::Row& row) {
      const double windows = time / (step_ * row.lag);
      return row.pairs.error && windows >= enough_windows && windows * channels >= enough_displacements;
    };
    const auto longest = std::find_if(rows.rbegin(), rows.rend(), holds_enough);
    if (longest == rows.rend()) {
      scalar.note =
          fmt::format("the run is too short: of no lag does it hold {:.0f} displacements along an axis", enough_displacements);
      return scalar;
    }
    const double lag = step_ * longest->lag;
    scalar.note = fmt::format("at lag {:.4g}, the longest of which the run holds {:.0f} displacements along an axis", lag,
                              enough_displacements);
    longest->fill(scalar, step_, 0.5 / lag);  // 2 of one component over 4 t
    return scalar;
  }

  std::vector<TrackedDisks> tracked_;
  std::vector<MultipleTau> ladders_;
};

}  // namespace

MadeObservable make_mean_square_displacement(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<MeanSquareDisplacement>(request, run);
}

}  // namespace carom
