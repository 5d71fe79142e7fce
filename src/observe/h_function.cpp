// Boltzmann's H = integral of f ln f over velocities, f the distribution of all disks at one instant, against time. Each species
// has its own f; H is their mean over disks.
//
// f is a histogram in v_x and v_y with bins half a thermal velocity wide. The plug-in estimate is too high by (occupied bins - 1)
// / 2 N, which is taken away (Miller 1955). Its standard error is that of the jackknife over disks, for the scatter of ln f
// leaves out that the histogram scatters too: by that alone errors were 1.8 times too small with 36 disks, and 1.3 times with
// 300. With fewer than 300 the jackknife's is too large, by up to 1.4 times. What is left of the bias is in the number to compare
// it with, h_of_maxwell(). At most 1024 instants are kept: when they are full every other one goes and the steps are twice as
// long.

#include "observe/blocking.hpp"
#include "observe/h_of_maxwell.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/thinned_rows.hpp"

#include <fmt/format.h>

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
      const double kT = run.energy_scale() > 0.0 ? run.energy_scale() : 1.0;
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
      const Estimate found = estimate(counts[s], disks[s]);
      const double weight = disks[s] / all;
      h += weight * (found.mean - std::log(cell));
      variance += weight * weight * found.variance;
    }
    rows_.add(state.time, {h, std::sqrt(variance)});
  }

  struct Estimate {
    double mean = 0.0;  ///< of ln of the share of disks in a disk's bin, less Miller's bias
    double variance = unknown;
  };
  /// Returns the estimate from the numbers of disks in bins, with the variance of the jackknife over disks: it is unknown where
  /// each disk is as good as any other.
  static Estimate estimate(const std::vector<double>& counts, double disks) {
    const auto x_log_x = [](double x) { return x > 0.0 ? x * std::log(x) : 0.0; };
    const auto mean_of = [](double sum, double occupied, double of_disks) {
      return sum / of_disks - std::log(of_disks) - (occupied - 1.0) / (2.0 * of_disks);
    };
    double sum = 0.0, occupied = 0.0;
    for (const double count : counts) sum += x_log_x(count), occupied += count > 0.0 ? 1.0 : 0.0;
    Estimate found{.mean = mean_of(sum, occupied, disks)};
    double without = 0.0, squares = 0.0;
    for (const double count : counts) {
      if (count == 0.0) continue;
      const double left =
          mean_of(sum - x_log_x(count) + x_log_x(count - 1.0), occupied - (count == 1.0 ? 1.0 : 0.0), disks - 1.0);
      without += count * left;
      squares += count * left * left;
    }
    const double variance = (disks - 1.0) / disks * (squares - without * without / disks);
    if (variance > 1e-12 * squares) found.variance = variance;
    return found;
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    if (beyond_)
      found.note = fmt::format("some velocities were beyond the histogram, 16 {} to either side",
                               run_.temperature > 0.0 ? "thermal velocities of the start"
                                                      : "times an estimate of how fast disks become that begin at rest");
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
