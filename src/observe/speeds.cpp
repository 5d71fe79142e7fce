// Distributions of speeds and kinetic energies: densities over samples, also per species where there are several. Averages over
// time.

#include "observe/blocking.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

namespace {

/// Histograms of one quantity from 0 to `range`, of all disks (first) and of each species.
class Distribution {
 public:
  Distribution(std::size_t bins, double range, std::size_t kinds)
      : width_(range / static_cast<double>(bins)), bins_(bins), shares_(kinds, BlockedColumn(bins)), counts_(kinds * bins) {}

  void add(std::size_t kind, double x) {
    const double bin = x / width_;
    if (bin < static_cast<double>(bins_)) counts_[kind * bins_ + static_cast<std::size_t>(bin)] += 1.0;
    if (kind == 0) (bin < static_cast<double>(bins_) ? within_ : beyond_) += 1.0;
  }
  /// Returns the fraction of all disks at all times that was beyond the histogram.
  [[nodiscard]] double share_beyond() const { return beyond_ > 0.0 ? beyond_ / (within_ + beyond_) : 0.0; }
  void end_sample(const std::vector<double>& disks) {
    for (std::size_t kind = 0; kind < shares_.size(); ++kind)
      for (std::size_t b = 0; b < bins_; ++b) shares_[kind].add(b, counts_[kind * bins_ + b], disks[kind]);
    std::fill(counts_.begin(), counts_.end(), 0.0);
  }
  [[nodiscard]] bool has_lower_bounds() const { return std::ranges::any_of(shares_, &BlockedColumn::has_lower_bounds); }
  [[nodiscard]] Table table(const std::string& name, const std::string& unit, const std::string& per_unit,
                            const ObservedRun& run) const {
    Table table{.name = name};
    Column middles{"middle", unit, {}};
    for (std::size_t b = 0; b < bins_; ++b) middles.values.push_back((static_cast<double>(b) + 0.5) * width_);
    table.columns.push_back(std::move(middles));
    for (std::size_t kind = 0; kind < shares_.size(); ++kind)
      shares_[kind].put(table, kind == 0 ? "density" : "density" + run.suffix(kind - 1), per_unit, 1.0 / width_);
    return table;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(shares_, counts_, within_, beyond_);
  }

 private:
  double width_;
  std::size_t bins_;
  std::vector<BlockedColumn> shares_;
  std::vector<double> counts_;
  double within_ = 0.0, beyond_ = 0.0;  ///< of all kinds together
};

class Speeds final : public SavedObservable<Speeds> {
 public:
  Speeds(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        kinds_(run.species_count() > 1 ? 1 + run.species_count() : 1),
        speeds_(static_cast<std::size_t>(request.bins.value_or(100)), 5.0 * std::sqrt(energy(run) / lightest(run)), kinds_),
        energies_(static_cast<std::size_t>(request.bins.value_or(100)), 12.5 * energy(run), kinds_) {
    disks_.push_back(static_cast<double>(run.disks.count()));
    if (kinds_ > 1)
      for (const Species& species : run.scene.species) disks_.push_back(static_cast<double>(species.count));
  }

  [[nodiscard]] bool needs_positions() const override { return run_.has_flow(); }

  void sample(const State& state, const Totals&) override {
    const Eigen::Matrix2Xd v = peculiar_velocities(run_, state);
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const double square = v.col(static_cast<Eigen::Index>(i)).squaredNorm();
      const double speed = std::sqrt(square), energy = 0.5 * run_.disks.mass[i] * square;
      put(0, speed, energy);
      if (kinds_ > 1) put(1 + static_cast<std::size_t>(run_.disks.species[i]), speed, energy);
    }
    speeds_.end_sample(disks_);
    energies_.end_sample(disks_);
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    // In equilibrium the fraction is one in e^12.5 = 270,000.
    if (const double beyond = std::max(speeds_.share_beyond(), energies_.share_beyond()); beyond > 1e-3)
      found.note = fmt::format(
          "{:.2g} % are beyond the histograms, which are scaled with {}", 100.0 * beyond,
          run_.temperature > 0.0 ? "the temperature of the start" : "an estimate of how fast disks become that begin at rest");
    found.tables.push_back(speeds_.table("speeds", "length / time", "time / length", run_));
    note_lower_bounds(found, speeds_.has_lower_bounds() || energies_.has_lower_bounds());
    found.tables.push_back(energies_.table("energies", "energy", "1 / energy", run_));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(speeds_, energies_);
  }

 private:
  /// Returns the energy by which histograms are scaled: one disk in e^12.5 has more than 12.5 kT.
  static double energy(const ObservedRun& run) { return run.energy_scale() > 0.0 ? run.energy_scale() : 1.0; }
  static double lightest(const ObservedRun& run) {
    return run.disks.count() == 0 ? 1.0 : *std::min_element(run.disks.mass.begin(), run.disks.mass.end());
  }
  void put(std::size_t kind, double speed, double energy) {
    speeds_.add(kind, speed);
    energies_.add(kind, energy);
  }

  std::size_t kinds_;
  Distribution speeds_, energies_;
  std::vector<double> disks_;
};

}  // namespace

MadeObservable make_speeds(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Speeds>(request, run);
}

}  // namespace carom
