// Intermediate scattering functions of one wave number or several: of all disks together, F(k,t) = <rho_k(t) rho_k(0)*> / N with
// rho_k = sum exp(i k.r), and of each by itself, F_s(k,t) = <exp(i k.(r(t) - r(0)))>. F(k,0) = S(k). Averages over time and over
// four wave vectors that fit the periodic box, nearest to that number in four directions. Motion of the centre of mass is left
// out. Names end with the wave number where a scene has a list of them: "F_self_3.5".

#include "observe/lagged_rows.hpp"
#include "observe/observables.hpp"
#include "observe/relaxation_time.hpp"
#include "observe/saved_observable.hpp"
#include "scene/wave_vectors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// What is gathered of one wave number.
class WaveNumber {
 public:
  /// Requires the wave number in the inverse unit of length. `suffix` ends all its names.
  WaveNumber(double k, std::string suffix, const ObservedRun& run)
      : suffix_(std::move(suffix)),
        vectors_(detail::wave_vectors_near(k, run.scene.box.lengths())),
        modes_(2 * vectors_.size()),
        self_(run.species_count()) {}

  /// Takes displacements of disks of one species at a lag, x and y of each in turn.
  void add_displacements(std::size_t species, std::size_t row, std::span<const double> moved) {
    double sum = 0.0;
    for (std::size_t c = 0; c < moved.size(); c += 2)
      for (const Eigen::Vector2d& k : vectors_) sum += std::cos(k.x() * moved[c] + k.y() * moved[c + 1]);
    self_[species].add(row, 2.0 * sum / (count() * static_cast<double>(moved.size())));
  }

  /// Takes the places of all disks at the next step, less the displacement of the centre of mass.
  void add_positions(const Eigen::Matrix2Xd& positions, const Eigen::Vector2d& drift) {
    std::vector<double> modes(2 * vectors_.size());
    for (std::size_t v = 0; v < vectors_.size(); ++v)
      for (Eigen::Index i = 0; i < positions.cols(); ++i) {
        const double phase = vectors_[v].dot(positions.col(i) - drift);
        modes[2 * v] += std::cos(phase);
        modes[2 * v + 1] += std::sin(phase);
      }
    modes_.add(modes, [&](std::size_t row, std::span<const double> earlier) {
      double sum = 0.0;
      for (std::size_t c = 0; c < modes.size(); ++c) sum += modes[c] * earlier[c];
      all_.add(row, sum / (count() * static_cast<double>(positions.cols())));
    });
  }

  [[nodiscard]] std::size_t rows() const { return all_.size(); }

  void put_scalars(Measurement& found, const ObservedRun& run, const DisksAtLags& followed, double step) const {
    double k = 0.0;
    for (const Eigen::Vector2d& vector : vectors_) k += vector.norm() / count();
    found.scalars.push_back({.name = "k" + suffix_, .unit = "1 / length", .value = k, .note = "mean length of the wave vectors"});
    for (std::size_t s = 0; s < self_.size(); ++s)
      if (followed.channels(s) > 0)
        found.scalars.push_back(relaxation_time("relaxation_time" + run.suffix(s) + suffix_, self_[s], step, "F_self"));
  }

  /// Returns whether many of the errors are lower bounds.
  [[nodiscard]] bool put_columns(Table& table, const ObservedRun& run) const {
    LaggedColumn all("F" + suffix_, "");
    for (std::size_t row = 0; row < all_.size(); ++row) all.add(all_, row);
    bool some_are_bounds = all.put(table);
    for (std::size_t s = 0; s < self_.size(); ++s) {
      if (self_[s].size() == 0) continue;
      LaggedColumn self("F_self" + run.suffix(s) + suffix_, "");
      for (std::size_t row = 0; row < all_.size(); ++row) self.add(self_[s], row);
      some_are_bounds = self.put(table) || some_are_bounds;
    }
    return some_are_bounds;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(modes_, self_, all_);
  }

 private:
  [[nodiscard]] double count() const { return static_cast<double>(vectors_.size()); }

  std::string suffix_;
  std::vector<Eigen::Vector2d> vectors_;
  LaggedStates modes_;
  std::vector<LaggedRows> self_;  ///< by species
  LaggedRows all_;
};

class IntermediateScattering final : public SavedObservable<IntermediateScattering> {
 public:
  IntermediateScattering(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run), followed_(request, run) {
    for (const double k : request.wave_numbers) numbers_.emplace_back(k / run.mean_diameter, fmt::format("_{:.6g}", k), run);
    if (numbers_.empty()) numbers_.emplace_back(request.largest.value_or(6.3) / run.mean_diameter, "", run);
  }

  void sample(const State& state, const Totals&) override {
    const Eigen::Vector2d drift = non_thermal_displacement(run_, state);
    followed_.add(run_, state, drift, [&](std::size_t s, std::size_t row, std::span<const double> moved) {
      for (WaveNumber& number : numbers_) number.add_displacements(s, row, moved);
    });
    for (WaveNumber& number : numbers_) number.add_positions(state.positions, drift);
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    for (const WaveNumber& number : numbers_) number.put_scalars(found, run_, followed_, step_);
    if (numbers_[0].rows() == 0) {
      found.note = "the run is too short";
      return found;
    }
    Table table{.name = name()};
    table.columns.push_back(lag_column(0, numbers_[0].rows(), step_));
    bool some_are_bounds = false;
    for (const WaveNumber& number : numbers_) some_are_bounds = number.put_columns(table, run_) || some_are_bounds;
    note_lower_bounds(found, some_are_bounds);
    note_moments(found, run_, step_);
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(followed_);
    for (WaveNumber& number : numbers_) archive(number);
  }

 private:
  DisksAtLags followed_;
  std::vector<WaveNumber> numbers_;  ///< in the order of the scene
};

}  // namespace

MadeObservable make_intermediate_scattering(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<IntermediateScattering>(request, run);
}

}  // namespace carom
