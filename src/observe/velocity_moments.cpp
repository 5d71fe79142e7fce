// Moments of the velocities, per species: <v^2>, <v^4> and the kurtosis <v^4> / <v^2>^2, which is 2 in a Maxwell gas and 2 (N -
// 1) / N for N equal disks whose energy and momentum are kept. Averages over time.

#include "observe/blocking.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <cmath>
#include <vector>

namespace carom {

namespace {

class VelocityMoments final : public SavedObservable<VelocityMoments> {
 public:
  VelocityMoments(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run), species_(run.species_count()) {}

  [[nodiscard]] bool needs_positions() const override { return run_.has_flow(); }

  void sample(const State& state, const Totals&) override {
    const Eigen::Matrix2Xd v = peculiar_velocities(run_, state);
    std::vector<Sums> sums(species_.size());
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      Sums& sum = sums[static_cast<std::size_t>(run_.disks.species[i])];
      const double x = v(0, static_cast<Eigen::Index>(i)), y = v(1, static_cast<Eigen::Index>(i));
      const double square = x * x + y * y;
      sum.speed += std::sqrt(square);
      sum.second += square;
      sum.fourth += square * square;
      sum.x2 += x * x, sum.y2 += y * y, sum.x4 += x * x * x * x, sum.y4 += y * y * y * y;
      sum.x3 += x * x * x, sum.y3 += y * y * y;
    }
    for (std::size_t s = 0; s < sums.size(); ++s) {
      const Sums& sum = sums[s];
      if (run_.scene.species[s].count == 0) continue;
      const double share = 1.0 / static_cast<double>(run_.scene.species[s].count);
      Series& series = species_[s];
      series.speed.add(share * sum.speed);
      series.second.add(share * sum.second);
      series.fourth.add(share * sum.fourth);
      series.x3.add(share * sum.x3), series.y3.add(share * sum.y3);
      series.kurtosis.add(share * sum.fourth, share * sum.second);
      series.kurtosis_x.add(share * sum.x4, share * sum.x2);
      series.kurtosis_y.add(share * sum.y4, share * sum.y2);
    }
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    const char* const none = "nothing moves, or nothing was measured";
    Measurement found{.name = name()};
    for (std::size_t s = 0; s < species_.size(); ++s) {
      const Series& series = species_[s];
      put(found, {.name = "speed" + run_.suffix(s), .unit = "length / time"}, series.speed);
      put(found, {.name = "v2" + run_.suffix(s), .unit = "length^2 / time^2"}, series.second);
      put(found, {.name = "v4" + run_.suffix(s), .unit = "length^4 / time^4"}, series.fourth);
      put(found, {.name = "vx3" + run_.suffix(s), .unit = "length^3 / time^3"}, series.x3);
      put(found, {.name = "vy3" + run_.suffix(s), .unit = "length^3 / time^3"}, series.y3);
      put(found, {.name = "kurtosis" + run_.suffix(s)}, series.kurtosis, none, 1.0, 0.0, 2);
      put(found, {.name = "kurtosis_x" + run_.suffix(s)}, series.kurtosis_x, none, 1.0, 0.0, 2);
      put(found, {.name = "kurtosis_y" + run_.suffix(s)}, series.kurtosis_y, none, 1.0, 0.0, 2);
    }
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(species_);
  }

 private:
  struct Sums {
    double speed = 0.0, second = 0.0, fourth = 0.0, x2 = 0.0, y2 = 0.0, x3 = 0.0, y3 = 0.0, x4 = 0.0, y4 = 0.0;
  };
  struct Series {
    Blocking speed, second, fourth, x3, y3;
    Blocking kurtosis, kurtosis_x, kurtosis_y;  ///< of <v^4> / <v^2>^2

    template <class Archive>
    void serialize(Archive& archive) {
      archive(speed, second, fourth, x3, y3, kurtosis, kurtosis_x, kurtosis_y);
    }
  };

  std::vector<Series> species_;
};

}  // namespace

MadeObservable make_velocity_moments(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<VelocityMoments>(request, run);
}

}  // namespace carom
