// Radial distribution g(r): pairs at distance r over those of an ideal gas, N (N - 1) / 2 pairs spread over the area. Averages
// over time. With several species also for each pair of them.
//
// The contact value g(sigma+) of disks of one size comes from bins of their own next to contact: the cubic through them, taken at
// contact. Each bin's count is compared with the cubic's integral over the bin, so the width of bins enters no further. The
// cubic's own error is below 1e-3 where g falls by no more than exp(-1.7) over all bins. They reach to 1.25 sigma in a fluid, and
// in a crystal to 1.7 times its mean gap between neighbours, over which g falls by about e. The value at contact is a linear
// function of the counts, so blocking gives its error.

#include "core/all_equal.hpp"
#include "observe/blocking.hpp"
#include "observe/close_pairs.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "scene/checks.hpp"
#include "scene/contact_scales.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// Weights w such that sum w_b (count of pairs in bin b) / (pairs per area of an ideal gas) is a cubic's value at contact.
class Contact {
 public:
  static constexpr int bins = 16;
  static constexpr int degree = 3;

  explicit Contact(double sigma, double reach)
      : sigma_(sigma), width_((reach - sigma) / bins), weights_(Eigen::VectorXd::Zero(bins)) {
    if (!(width_ > 0.0)) return;
    // Integral of 2 pi r x^k over a bin, x being the part of all bins that r is beyond sigma: all in units of a bin's width, so
    // that no unit of length makes columns of sizes that differ.
    Eigen::MatrixXd model(bins, degree + 1);
    for (int b = 0; b < bins; ++b) {
      const double from = static_cast<double>(b) / bins, to = static_cast<double>(b + 1) / bins;
      for (int k = 0; k <= degree; ++k)
        model(b, k) = 2.0 * std::numbers::pi * bins *
                      (sigma / width_ * (std::pow(to, k + 1) - std::pow(from, k + 1)) / (k + 1) +
                       bins * (std::pow(to, k + 2) - std::pow(from, k + 2)) / (k + 2));
    }
    // Counts of about equal rings scatter about equally, so least squares need no weights.
    const Eigen::MatrixXd inverse = model.completeOrthogonalDecomposition().pseudoInverse();
    weights_ = inverse.row(0).transpose() / (width_ * width_);
  }

  [[nodiscard]] bool known() const { return width_ > 0.0; }
  [[nodiscard]] double reach() const { return known() ? sigma_ + width_ * bins : 0.0; }
  [[nodiscard]] double weight(double r) const {
    const double bin = (r - sigma_) / width_;
    if (!known() || bin >= bins) return 0.0;
    return weights_[std::max(0, static_cast<int>(bin))];
  }

 private:
  double sigma_, width_;
  Eigen::VectorXd weights_;
};

class RadialDistribution final : public SavedObservable<RadialDistribution> {
 public:
  RadialDistribution(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        range_(request.range.value_or(5.0) * run.mean_diameter),
        width_(range_ / static_cast<double>(request.bins.value_or(250))),
        kinds_(run.species_count()),
        g_(static_cast<std::size_t>(request.bins.value_or(250))),
        counts_(kinds_ > 1 ? 1 + kinds_ * kinds_ : 1, std::vector<double>(g_.size())),
        contact_(run.mean_diameter,
                 touch_at_one_distance(run) ? std::min(range_, smooth_until(run) * run.mean_diameter) : run.mean_diameter) {
    if (kinds_ > 1) partial_.resize(kinds_ * kinds_, BlockedColumn(g_.size()));
  }

  static bool touch_at_one_distance(const ObservedRun& run) {
    return all_equal(run.disks.radius) && contact_scales<double>(run.scene.effects, run.disks).additive();
  }

  /// Returns the distance, in diameters, up to which a cubic can follow g: it jumps at the edges of the potential, and in a
  /// crystal falls within the gap between neighbours, sqrt(closest packing / packing fraction) - 1.
  static double smooth_until(const ObservedRun& run) {
    const std::vector<PotentialStep> steps = run.scene.effects.potential_steps();
    const double gap = std::sqrt(detail::closest_packing / run.scene.packing_fraction()) - 1.0;
    const double smooth = std::min(1.25, 1.0 + std::max(1.7 * gap, 1e-3));
    return steps.empty() ? smooth : std::min(smooth, steps.front().width);
  }

  void sample(const State& state, const Totals&) override {
    for (std::vector<double>& column : counts_) std::fill(column.begin(), column.end(), 0.0);
    double at_contact = 0.0;
    for_each_close_pair(run_.scene.box, state.positions, range_, [&](Eigen::Index i, Eigen::Index j, const Eigen::Vector2d& r) {
      const double distance = r.norm();
      const std::size_t bin = std::min(static_cast<std::size_t>(distance / width_), g_.size() - 1);
      counts_[0][bin] += 1.0;
      at_contact += contact_.weight(distance);
      if (kinds_ == 1) return;
      const auto a = static_cast<std::size_t>(run_.disks.species[static_cast<std::size_t>(i)]);
      const auto b = static_cast<std::size_t>(run_.disks.species[static_cast<std::size_t>(j)]);
      counts_[1 + std::min(a, b) * kinds_ + std::max(a, b)][bin] += 1.0;
    });
    const double area = run_.scene.box.area(), count = static_cast<double>(run_.disks.count());
    const double pairs = 0.5 * count * (count - 1.0) / area;
    contact_value_.add(at_contact / pairs);
    for (std::size_t b = 0; b < g_.size(); ++b) {
      g_.add(b, counts_[0][b] / (pairs * ring(b)));
      for (std::size_t k = 0; k < partial_.size(); ++k)
        if (const double of_kinds = pairs_of(k) / area; of_kinds > 0.0)
          partial_[k].add(b, counts_[1 + k][b] / (of_kinds * ring(b)));
    }
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    Scalar contact{.name = "contact"};
    if (contact_.known()) {
      contact_value_.fill(contact, step_);
      if (!contact.value) contact.note = "nothing was measured";
    } else {
      contact.note = touch_at_one_distance(run_)    ? "the range ends where disks touch or before; make it longer"
                     : all_equal(run_.disks.radius) ? "disks of several species touch at several distances"
                                                    : "disks of several sizes touch at several distances";
    }
    found.scalars.push_back(std::move(contact));
    Table table{.name = name()};
    Column middles{"r", "length", {}};
    for (std::size_t b = 0; b < g_.size(); ++b) middles.values.push_back((static_cast<double>(b) + 0.5) * width_);
    table.columns.push_back(std::move(middles));
    g_.put(table, "g", "");
    for (std::size_t k = 0; k < partial_.size(); ++k) {
      const std::size_t a = k / kinds_, b = k % kinds_;
      if (a <= b && pairs_of(k) > 0.0) partial_[k].put(table, "g" + run_.suffix(a) + run_.suffix(b), "");
    }
    note_lower_bounds(found, g_.has_lower_bounds() || std::ranges::any_of(partial_, &BlockedColumn::has_lower_bounds));
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(g_, partial_, contact_value_);
  }

 private:
  [[nodiscard]] double ring(std::size_t bin) const {
    return std::numbers::pi * width_ * width_ * (2.0 * static_cast<double>(bin) + 1.0);
  }
  [[nodiscard]] double pairs_of(std::size_t k) const {
    const std::size_t a = k / kinds_, b = k % kinds_;
    const double first = static_cast<double>(run_.scene.species[a].count),
                 second = static_cast<double>(run_.scene.species[b].count);
    return a > b ? 0.0 : a == b ? 0.5 * first * (first - 1.0) : first * second;
  }

  double range_, width_;
  std::size_t kinds_;
  BlockedColumn g_;
  std::vector<BlockedColumn> partial_;
  std::vector<std::vector<double>> counts_;  ///< of one state: all pairs, then pairs of species
  Contact contact_;
  Blocking contact_value_;
};

}  // namespace

MadeObservable make_radial_distribution(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<RadialDistribution>(request, run);
}

}  // namespace carom
