// Boltzmann's H = integral of f ln f over velocities, f the distribution of all disks at one instant, against time. Each species
// has its own f; H is their mean over disks.
//
// f is a histogram in v_x and v_y with bins half a thermal velocity wide. The plug-in estimate is too high by (occupied bins - 1)
// / 2 N, which is taken away (Miller 1955); its standard error is that of a mean of ln f over N disks. What is left of the bias
// is in the number to compare it with, h_of_maxwell(). At most 1024 instants are kept: when they are full every other one goes
// and the steps are twice as long.

#include "observe/h_of_maxwell.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/thinned_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace carom {

namespace {

class HFunction final : public SavedObservable<HFunction> {
 public:
  HFunction(const ObservableRequest& request, const ObservedRun& run) : SavedObservable(request, run) {
    for (std::size_t s = 0; s < run.species_count(); ++s) {
      double mass = 0.0, count = 0.0;
      for (std::size_t i = 0; i < run.disks.count(); ++i)
        if (run.disks.species[i] == static_cast<std::int32_t>(s)) mass += run.disks.mass[i], count += 1.0;
      const double kT = run.temperature > 0.0 ? run.temperature : 1.0;
      thermal_.push_back(count > 0.0 ? std::sqrt(kT * count / mass) : 1.0);
    }
  }

  [[nodiscard]] bool needs_positions() const override { return run_.has_flow(); }

  void sample(const State& state, const Totals&) override {
    if (!rows_.takes_next()) return;
    const Eigen::Matrix2Xd v = peculiar_velocities(run_, state);
    const std::size_t kinds = thermal_.size();
    std::vector<std::vector<double>> counts(kinds, std::vector<double>(side * side));
    std::vector<double> disks(kinds);
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const auto s = static_cast<std::size_t>(run_.disks.species[i]);
      counts[s][bin(v(1, static_cast<Eigen::Index>(i)), s) * side + bin(v(0, static_cast<Eigen::Index>(i)), s)] += 1.0;
      disks[s] += 1.0;
      const double fastest = v.col(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff();
      beyond_ = beyond_ || fastest > 0.5 * static_cast<double>(side) * h_bin * thermal_[s];
    }
    double h = 0.0, variance = 0.0;
    const double all = static_cast<double>(run_.disks.count());
    for (std::size_t s = 0; s < kinds; ++s) {
      if (disks[s] == 0.0) continue;
      const double cell = h_bin * h_bin * thermal_[s] * thermal_[s];
      double mean = 0.0, square = 0.0, occupied = 0.0;
      for (const double count : counts[s]) {
        if (count == 0.0) continue;
        const double share = count / disks[s], log = std::log(share / cell);
        mean += share * log;
        square += share * log * log;
        occupied += 1.0;
      }
      const double weight = disks[s] / all;
      h += weight * (mean - (occupied - 1.0) / (2.0 * disks[s]));
      variance += weight * weight * std::max(0.0, square - mean * mean) / disks[s];
    }
    rows_.add(state.time, {h, std::sqrt(variance)});
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    if (beyond_) found.note = "some velocities were beyond the histogram, 16 thermal velocities of the start to either side";
    found.tables.push_back(
        {.name = name(),
         .columns = {{"time", "time", rows_.times()}, {"H", "", rows_.column(0)}, {"H_error", "", rows_.column(1)}}});
    Scalar exact{.name = "maxwell", .note = "of Maxwell's distribution at the temperature of the start"};
    Scalar expected{.name = "maxwell_expected",
                    .note = "what H is on average in these bins, for as many velocities drawn from that distribution"};
    if (run_.temperature > 0.0) {
      exact.value = expected.value = 0.0;
      for (std::size_t s = 0; s < thermal_.size(); ++s) {
        const std::int64_t count = run_.scene.species[s].count;
        if (count == 0) continue;
        const double share = static_cast<double>(count) / static_cast<double>(run_.disks.count());
        const double thermal_area = std::log(thermal_[s] * thermal_[s]);
        *exact.value -= share * (1.0 + std::log(2.0 * std::numbers::pi) + thermal_area);
        *expected.value += share * (h_of_maxwell(count) - thermal_area);
      }
    } else {
      exact.note = expected.note = "nothing moves at the start";
    }
    found.scalars.push_back(std::move(exact));
    found.scalars.push_back(std::move(expected));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows_, beyond_);
  }

 private:
  static constexpr std::size_t side =
      64;  ///< bins per component, 16 thermal velocities to either side; what is beyond is in the last

  [[nodiscard]] std::size_t bin(double v, std::size_t s) const {
    const double at = std::floor(v / (h_bin * thermal_[s])) + 0.5 * static_cast<double>(side);
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(side - 1)));
  }

  std::vector<double> thermal_;  ///< velocity, of each species
  ThinnedRows rows_{2};          ///< H and its error
  bool beyond_ = false;          ///< a velocity was in the last bin that belongs behind it
};

}  // namespace

MadeObservable make_h_function(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<HFunction>(request, run);
}

}  // namespace carom
