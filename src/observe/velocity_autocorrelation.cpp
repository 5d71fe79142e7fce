// Velocity autocorrelation <v(0).v(t)> and its running integral, Green and Kubo's diffusion coefficient D(t). Averages over time,
// of some disks of each species.
//
// Short lags use velocities at instants. Longer ones use mean velocities over a window (column `window`), which displacements
// give exactly however often disks collide in between; the integral uses these throughout. The initial slope, too, is exact: the
// correlation falls at the rate sum over collisions of |change of v|^2 / 2, over <v^2> N t.

#include "observe/blocking.hpp"
#include "observe/multiple_tau.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/tracked_disks.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace carom {

namespace {

class VelocityAutocorrelation final : public SavedObservable<VelocityAutocorrelation> {
 public:
  VelocityAutocorrelation(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run), slopes_(run.species_count()), changes_(run.species_count()), noted_(run.species_count()) {
    const Effects& effects = run.scene.effects;
    const bool curved = !effects.acceleration().isZero(0.0);
    follows_ = run.collisions_known && !curved && !is_driven(effects) && run.conserves_momentum(0) && run.conserves_momentum(1);
    for (std::size_t s = 0; s < run.species_count(); ++s) {
      tracked_.emplace_back(request, run, s);
      instants_.emplace_back(tracked_.back().channels(), MultipleTau::Pairs::products, lags, 1);
      means_.emplace_back(tracked_.back().channels(), MultipleTau::Pairs::products, lags);
    }
    before_.resize(tracked_.size());
  }

  [[nodiscard]] bool follows_collisions() const override { return follows_; }

  void collisions(std::span<const PairCollision> collisions) override {
    for (const PairCollision& met : collisions) {
      changes_[species(met.disk)] += (met.velocity - met.velocity_before).squaredNorm();
      changes_[species(met.partner)] += (met.partner_velocity - met.partner_velocity_before).squaredNorm();
    }
  }

  void sample(const State& state, const Totals&) override {
    Eigen::Matrix2Xd peculiar = peculiar_velocities(run_, state);
    peculiar.colwise() -= drift_velocity(run_, state);
    const Eigen::Vector2d drift = non_thermal_displacement(run_, state);
    std::vector<double> squares(tracked_.size());
    for (std::size_t i = 0; i < run_.disks.count(); ++i)
      squares[static_cast<std::size_t>(run_.disks.species[i])] += peculiar.col(static_cast<Eigen::Index>(i)).squaredNorm();
    for (std::size_t s = 0; s < tracked_.size(); ++s) {
      if (tracked_[s].channels() == 0) continue;
      instants_[s].add(tracked_[s].velocities(peculiar));
      const std::span<const double> places = tracked_[s].unwrapped(run_, state, drift);
      std::vector<double>& before = before_[s];
      if (!before.empty()) {
        for (std::size_t c = 0; c < before.size(); ++c) before[c] = (places[c] - before[c]) / step_;
        means_[s].add(before);
        slopes_[s].add(0.5 * (changes_[s] - noted_[s]), squares[s] * step_);
      }
      before.assign(places.begin(), places.end());
      noted_[s] = changes_[s];
    }
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    Table table{.name = name()};
    std::vector<MultipleTau::Row> all;
    for (std::size_t s = 0; s < tracked_.size(); ++s) {
      if (follows_) {
        Scalar slope{.name = "initial_slope" + run_.suffix(s), .unit = "1 / time"};
        if (run_.scene.effects.dissipate())
          slope.note = "collisions take energy away, so the slope changes with time";
        else
          slopes_[s].fill(slope, step_);
        if (!slope.value && slope.note.empty()) slope.note = "nothing moves, or nothing was measured";
        found.scalars.push_back(std::move(slope));
      }
      const std::vector<MultipleTau::Row> means = means_[s].rows();
      put_columns(table, run_.suffix(s), instants_[s].rows(), means);
      all.insert(all.end(), means.begin(), means.end());
    }
    found.note = MultipleTau::note_on_errors(all);
    put_table(found, std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(instants_, means_, before_, slopes_, changes_, noted_);
  }

 private:
  static constexpr std::size_t lags = 16;

  [[nodiscard]] std::size_t species(std::int32_t disk) const {
    return static_cast<std::size_t>(run_.disks.species[static_cast<std::size_t>(disk)]);
  }

  /// A correlation is that of one component; both together are twice that.
  void put_columns(Table& table, const std::string& suffix, const std::vector<MultipleTau::Row>& instants,
                   const std::vector<MultipleTau::Row>& means) const {
    Column lag{"lag", "time", {}}, window{"window", "time", {}}, until{"integral_to", "time", {}};
    Column values{"correlation" + suffix, "length^2 / time^2", {}},
        errors{"correlation" + suffix + "_error", "length^2 / time^2", {}};
    Column diffusion{"diffusion" + suffix, "length^2 / time", {}},
        its_errors{"diffusion" + suffix + "_error", "length^2 / time", {}};
    ColumnComparison comparison, of_diffusion;
    for (std::size_t r = 0; r < means.size(); ++r) {
      const bool instant = means[r].width == 1.0 && r < instants.size();
      const MultipleTau::Row& row = instant ? instants[r] : means[r];
      lag.values.push_back(step_ * row.lag);
      window.values.push_back(instant ? 0.0 : step_ * row.width);
      values.values.push_back(2.0 * row.pairs.mean);
      comparison.add(row.halves, 2.0);
      errors.values.push_back(row.pairs.error ? 2.0 * *row.pairs.error : unknown);
      until.values.push_back(step_ * (means[r].lag + 0.5 * means[r].width));
      diffusion.values.push_back(step_ * means[r].integral->mean);
      of_diffusion.add(means[r].integral_halves, step_);
      its_errors.values.push_back(means[r].integral->error ? step_ * *means[r].integral->error : unknown);
    }
    if (means.empty()) return;
    if (table.columns.empty()) table.columns = {lag, window, until};
    comparison.put(table, values.name);
    of_diffusion.put(table, diffusion.name);
    for (Column* column : {&values, &errors, &diffusion, &its_errors}) table.columns.push_back(std::move(*column));
  }

  bool follows_;
  std::vector<TrackedDisks> tracked_;
  std::vector<MultipleTau> instants_, means_;
  std::vector<std::vector<double>> before_;  ///< unwrapped places at the last sample
  std::vector<Blocking> slopes_;
  std::vector<double> changes_, noted_;  ///< sums of |change of v|^2, now and at the last sample
};

}  // namespace

MadeObservable make_velocity_autocorrelation(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<VelocityAutocorrelation>(request, run);
}

}  // namespace carom
