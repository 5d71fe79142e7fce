// How much of a configuration is left after a time: the overlap Q(t), the share of the disks that are nearer to where they were
// than a distance a, and its fluctuations chi_4(t) = n (<Q^2> - <Q>^2) over origins, n disks. The
// relaxation time is where Q falls to 1/e. Averages over time. Motion of the centre of mass is left out.

#include "observe/lagged_rows.hpp"
#include "observe/observables.hpp"
#include "observe/relaxation_time.hpp"
#include "observe/saved_observable.hpp"

#include <cmath>
#include <vector>

namespace carom {

namespace {

class Overlap final : public SavedObservable<Overlap> {
 public:
  Overlap(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        followed_(request, run),
        square_(std::pow(request.range.value_or(0.3) * run.mean_diameter, 2)),
        overlap_(run.species_count()),
        squares_(run.species_count()) {}

  void sample(const State& state, const Totals&) override {
    const Eigen::Vector2d drift = non_thermal_displacement(run_, state);
    followed_.add(run_, state, drift, [&](std::size_t s, std::size_t row, std::span<const double> moved) {
      double near = 0.0;
      for (std::size_t c = 0; c < moved.size(); c += 2)
        if (moved[c] * moved[c] + moved[c + 1] * moved[c + 1] < square_) near += 1.0;
      const double q = 2.0 * near / static_cast<double>(moved.size());
      overlap_[s].add(row, q);
      squares_[s].add(row, q * q, q);
    });
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    Table table{.name = name()};
    bool is_part = false, some_are_bounds = false;
    for (std::size_t s = 0; s < run_.species_count(); ++s) {
      if (followed_.channels(s) > 0)
        found.scalars.push_back(relaxation_time("relaxation_time" + run_.suffix(s), overlap_[s], step_, "the overlap"));
      if (overlap_[s].size() < 2) continue;
      if (table.columns.empty()) table.columns.push_back(lag_column(1, overlap_[s].size(), step_));
      LaggedColumn overlap("overlap" + run_.suffix(s), ""), chi("chi_4" + run_.suffix(s), "");
      const double count = 0.5 * static_cast<double>(followed_.channels(s));
      is_part = is_part || static_cast<std::int64_t>(count) < run_.scene.species[s].count;
      for (std::size_t row = 1; row < overlap_[s].size(); ++row) {
        const auto q = overlap_[s].estimate(row);
        const double scale = q ? count * q->mean * q->mean : 0.0;  // of <Q^2> / <Q>^2
        overlap.add(overlap_[s], row);
        chi.add(squares_[s].estimate_of_variance(row), count);
        chi.comparison.add(in_proportion(squares_[s].halves(row, 2), 1.0, -1.0), scale);
      }
      some_are_bounds = overlap.put(table) || some_are_bounds;
      some_are_bounds = chi.put(table) || some_are_bounds;
    }
    if (is_part) found.note = "chi_4 is that of the followed disks alone; take disks = N for all";
    note_lower_bounds(found, some_are_bounds);
    note_moments(found, run_, step_);
    put_table(found, std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(followed_, overlap_, squares_);
  }

 private:
  DisksAtLags followed_;
  double square_;
  std::vector<LaggedRows> overlap_, squares_;  ///< by species: of Q, and of Q^2 with Q as its weight
};

}  // namespace

MadeObservable make_overlap(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Overlap>(request, run);
}

}  // namespace carom
