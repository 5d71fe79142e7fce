// Intermediate scattering functions of one wave number: of all disks together, F(k,t) = <rho_k(t) rho_k(0)*> / N with rho_k = sum
// exp(i k.r), and of each by itself, F_s(k,t) = <exp(i k.(r(t) - r(0)))>. F(k,0) = S(k). Averages over time and over four wave
// vectors that fit the periodic box, nearest to that number in four directions. Motion of the centre of mass is left out.

#include "observe/lagged_rows.hpp"
#include "observe/observables.hpp"
#include "observe/relaxation_time.hpp"
#include "observe/saved_observable.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// Returns wave vectors of a periodic box near a wave number, one of k and -k.
std::vector<Eigen::Vector2d> wave_vectors_near(double k, const Eigen::Vector2d& lengths) {
  constexpr int directions = 4;
  const Eigen::Vector2d unit = 2.0 * std::numbers::pi * lengths.cwiseInverse();
  std::vector<Eigen::Vector2d> found;
  for (int d = 0; d < directions; ++d) {
    const double angle = std::numbers::pi * (d + 0.25) / directions;  // off the axes, which are special in a lattice
    Eigen::Vector2d n(std::round(k * std::cos(angle) / unit.x()), std::round(k * std::sin(angle) / unit.y()));
    if (n == Eigen::Vector2d(0.0, 0.0)) n[unit.x() <= unit.y() ? 0 : 1] = 1.0;
    const Eigen::Vector2d vector = n.cwiseProduct(unit);
    const auto same = [&](const Eigen::Vector2d& other) { return other == vector || other == -vector; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(vector);
  }
  return found;
}

class IntermediateScattering final : public SavedObservable<IntermediateScattering> {
 public:
  IntermediateScattering(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        followed_(request, run),
        vectors_(wave_vectors_near(request.largest.value_or(6.3) / run.mean_diameter, run.scene.box.lengths())),
        modes_(2 * vectors_.size()),
        self_(run.species_count()) {}

  void sample(const State& state, const Totals&) override {
    const Eigen::Vector2d drift = state.time * non_thermal_velocity(run_, state);
    const auto count = static_cast<double>(vectors_.size());
    followed_.add(run_, state, drift, [&](std::size_t s, std::size_t row, std::span<const double> moved) {
      double sum = 0.0;
      for (std::size_t c = 0; c < moved.size(); c += 2)
        for (const Eigen::Vector2d& k : vectors_) sum += std::cos(k.x() * moved[c] + k.y() * moved[c + 1]);
      self_[s].add(row, 2.0 * sum / (count * static_cast<double>(moved.size())));
    });
    std::vector<double> modes(2 * vectors_.size());
    for (std::size_t v = 0; v < vectors_.size(); ++v)
      for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
        const double phase = vectors_[v].dot(state.positions.col(i) - drift);
        modes[2 * v] += std::cos(phase);
        modes[2 * v + 1] += std::sin(phase);
      }
    modes_.add(modes, [&](std::size_t row, std::span<const double> earlier) {
      double sum = 0.0;
      for (std::size_t c = 0; c < modes.size(); ++c) sum += modes[c] * earlier[c];
      all_.add(row, sum / (count * static_cast<double>(run_.disks.count())));
    });
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    double k = 0.0;
    for (const Eigen::Vector2d& vector : vectors_) k += vector.norm() / static_cast<double>(vectors_.size());
    found.scalars.push_back({.name = "k", .unit = "1 / length", .value = k, .note = "mean length of the wave vectors"});
    for (std::size_t s = 0; s < run_.species_count(); ++s)
      if (followed_.channels(s) > 0)
        found.scalars.push_back(relaxation_time("relaxation_time" + run_.suffix(s), self_[s], step_, "F_self"));
    if (all_.size() == 0) {
      found.note = "the run is too short";
      return found;
    }
    Table table{.name = name()};
    table.columns.push_back(lag_column(0, all_.size(), step_));
    LaggedColumn all("F", "");
    for (std::size_t row = 0; row < all_.size(); ++row) all.add(all_, row);
    all.put(table);
    for (std::size_t s = 0; s < self_.size(); ++s) {
      if (self_[s].size() == 0) continue;
      LaggedColumn self("F_self" + run_.suffix(s), "");
      for (std::size_t row = 0; row < all_.size(); ++row) self.add(self_[s], row);
      self.put(table);
    }
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(followed_, modes_, self_, all_);
  }

 private:
  DisksAtLags followed_;
  std::vector<Eigen::Vector2d> vectors_;
  LaggedStates modes_;
  std::vector<LaggedRows> self_;  ///< by species
  LaggedRows all_;
};

}  // namespace

MadeObservable make_intermediate_scattering(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<IntermediateScattering>(request, run);
}

}  // namespace carom
