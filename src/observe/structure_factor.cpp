// Structure factor S(k) = <|sum exp(i k.r)|^2> / N for wave vectors that fit the periodic box, averaged over directions. Average
// over time.
//
// Of each of some sixty shells of |k| a few vectors are taken, those nearest to evenly spread directions, and all of the smallest
// ones: the work per state is some three hundred N, however large the box.

#include "observe/blocking.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace carom {

namespace {

struct Shell {
  std::vector<Eigen::Vector2d> vectors;
  [[nodiscard]] double mean_length() const {
    double sum = 0.0;
    for (const Eigen::Vector2d& k : vectors) sum += k.norm();
    return sum / static_cast<double>(vectors.size());
  }
};

std::vector<Shell> shells_up_to(double largest, const Eigen::Vector2d& lengths) {
  constexpr int shells = 64, directions = 4, all_up_to = 3;
  const Eigen::Vector2d unit = 2.0 * std::numbers::pi * lengths.cwiseInverse();
  const double width = std::max(largest / shells, unit.maxCoeff());
  std::set<std::pair<long, long>> chosen;  // one of k and -k
  const auto choose = [&](long x, long y) {
    if (y < 0 || (y == 0 && x < 0)) x = -x, y = -y;
    const Eigen::Vector2d k(static_cast<double>(x) * unit.x(), static_cast<double>(y) * unit.y());
    if ((x != 0 || y != 0) && k.norm() <= largest) chosen.insert({x, y});
  };
  for (long x = -all_up_to; x <= all_up_to; ++x)
    for (long y = 0; y <= all_up_to; ++y) choose(x, y);
  for (double k = 0.5 * width; k <= largest; k += width) {
    for (int d = 0; d < directions; ++d) {
      const double angle = std::numbers::pi * (d + 0.25) / directions;  // off the axes, which are special in a lattice
      choose(std::lround(k * std::cos(angle) / unit.x()), std::lround(k * std::sin(angle) / unit.y()));
    }
  }
  std::vector<Shell> found(static_cast<std::size_t>(largest / width) + 1);
  for (const auto& [x, y] : chosen) {
    const Eigen::Vector2d k(static_cast<double>(x) * unit.x(), static_cast<double>(y) * unit.y());
    found[static_cast<std::size_t>(k.norm() / width)].vectors.push_back(k);
  }
  std::erase_if(found, [](const Shell& shell) { return shell.vectors.empty(); });
  return found;
}

class StructureFactor final : public SavedObservable<StructureFactor> {
 public:
  StructureFactor(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        shells_(shells_up_to(request.largest.value_or(20.0) / run.mean_diameter, run.scene.box.lengths())),
        values_(shells_.size()) {}

  void sample(const State& state, const Totals&) override {
    const double count = static_cast<double>(run_.disks.count());
    for (std::size_t s = 0; s < shells_.size(); ++s) {
      double sum = 0.0;
      for (const Eigen::Vector2d& k : shells_[s].vectors) {
        double real = 0.0, imaginary = 0.0;
        for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
          const double phase = k.dot(state.positions.col(i));
          real += std::cos(phase);
          imaginary += std::sin(phase);
        }
        sum += real * real + imaginary * imaginary;
      }
      values_.add(s, sum / (count * static_cast<double>(shells_[s].vectors.size())));
    }
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    if (shells_.empty()) {
      found.note = "no wave vector of this box is that small";
      return found;
    }
    Table table{.name = name()};
    Column lengths{"k", "1 / length", {}}, counts{"vectors", "", {}};
    for (const Shell& shell : shells_) {
      lengths.values.push_back(shell.mean_length());
      counts.values.push_back(static_cast<double>(shell.vectors.size()));
    }
    table.columns = {std::move(lengths), std::move(counts)};
    values_.put(table, "S", "");
    note_lower_bounds(found, values_.has_lower_bounds());
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(values_);
  }

 private:
  std::vector<Shell> shells_;
  BlockedColumn values_;
};

}  // namespace

MadeObservable make_structure_factor(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<StructureFactor>(request, run);
}

}  // namespace carom
