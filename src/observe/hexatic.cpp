// Sixfold order: psi_j = mean over the six nearest neighbours of exp(6 i theta), theta the direction to each; its mean over all
// disks Psi; and its correlation g6(r) = <Re conj(psi_j) psi_k> over pairs at distance r. Averages over time.

#include "observe/blocking.hpp"
#include "observe/close_pairs.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace carom {

namespace {

/// The nearest six, by distance.
struct Nearest {
  static constexpr std::size_t six = 6;
  std::array<double, six> squares{};
  std::array<Eigen::Vector2d, six> to;
  std::size_t count = 0;

  void offer(double square, const Eigen::Vector2d& direction) {
    if (count == six && square >= squares[six - 1]) return;
    std::size_t at = count < six ? count++ : six - 1;
    for (; at > 0 && squares[at - 1] > square; --at) {
      squares[at] = squares[at - 1];
      to[at] = to[at - 1];
    }
    squares[at] = square;
    to[at] = direction;
  }
  [[nodiscard]] std::complex<double> psi() const {
    std::complex<double> sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::complex<double> u = std::complex<double>(to[k].x(), to[k].y()) / std::sqrt(squares[k]);
      const std::complex<double> cube = u * u * u;
      sum += cube * cube;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
  }
};

/// A periodic box and its images side by side, no narrower than `width` in either direction.
struct Tiles {
  Box box;
  Eigen::Matrix2Xd positions;  ///< those of the first box come first
};
Tiles tiles_of(const Box& box, const Eigen::Matrix2Xd& positions, double width) {
  const Eigen::Vector2d lengths = box.lengths();
  const Eigen::Vector2d many = (width / lengths.array()).ceil().max(1.0);
  Tiles tiles{box, Eigen::Matrix2Xd(2, positions.cols() * static_cast<Eigen::Index>(many.prod()))};
  tiles.box.upper = box.lower + many.cwiseProduct(lengths);
  Eigen::Index at = 0;
  for (double y = 0.0; y < many.y(); ++y)
    for (double x = 0.0; x < many.x(); ++x, at += positions.cols())
      tiles.positions.middleCols(at, positions.cols()) = positions.colwise() + Eigen::Vector2d(x * lengths.x(), y * lengths.y());
  return tiles;
}

std::vector<std::complex<double>> local_order(const Box& box, const Eigen::Matrix2Xd& positions) {
  const auto count = static_cast<std::size_t>(positions.cols());
  std::vector<Nearest> nearest;
  for (double reach = 2.2 * std::sqrt(box.area() / static_cast<double>(count));; reach *= 2.0) {
    nearest.assign(count, {});
    const auto offer = [&](Eigen::Index i, const Eigen::Vector2d& r) {
      if (i < positions.cols()) nearest[static_cast<std::size_t>(i)].offer(r.squaredNorm(), r);
    };
    const Tiles tiles = tiles_of(box, positions, 2.0 * reach);
    for_each_close_pair(tiles.box, tiles.positions, reach, [&](Eigen::Index i, Eigen::Index j, const Eigen::Vector2d& r) {
      offer(i, r);
      offer(j, -r);
    });
    if (std::ranges::all_of(nearest, [](const Nearest& near) { return near.count == Nearest::six; })) break;
  }
  std::vector<std::complex<double>> psi;
  for (const Nearest& near : nearest) psi.push_back(near.psi());
  return psi;
}

class Hexatic final : public SavedObservable<Hexatic> {
 public:
  Hexatic(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        range_(request.range.value_or(10.0) * run.mean_diameter),
        correlation_(static_cast<std::size_t>(request.bins.value_or(100))),
        width_(range_ / static_cast<double>(correlation_.size())) {}

  void sample(const State& state, const Totals&) override {
    const std::vector<std::complex<double>> psi = local_order(run_.scene.box, state.positions);
    const double share = 1.0 / static_cast<double>(psi.size());
    std::complex<double> global = 0.0;
    double local = 0.0, square = 0.0;
    for (const std::complex<double>& one : psi) {
      global += share * one;
      local += share * std::abs(one);
      square += share * std::norm(one);
    }
    local_.add(local);
    local_square_.add(square);
    global_.add(std::abs(global));
    global_square_.add(std::norm(global));
    std::vector<double> sums(correlation_.size()), pairs(correlation_.size());
    for_each_close_pair(run_.scene.box, state.positions, range_, [&](Eigen::Index i, Eigen::Index j, const Eigen::Vector2d& r) {
      const std::size_t bin = std::min(static_cast<std::size_t>(r.norm() / width_), sums.size() - 1);
      sums[bin] += (std::conj(psi[static_cast<std::size_t>(i)]) * psi[static_cast<std::size_t>(j)]).real();
      pairs[bin] += 1.0;
    });
    for (std::size_t b = 0; b < sums.size(); ++b) correlation_.add(b, sums[b], pairs[b]);
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    put(found, {.name = "local"}, local_);
    put(found, {.name = "local_square"}, local_square_);
    put(found, {.name = "global"}, global_);
    put(found, {.name = "global_square"}, global_square_);
    Table table{.name = "hexatic_correlation"};
    Column middles{"r", "length", {}};
    for (std::size_t b = 0; b < correlation_.size(); ++b) middles.values.push_back((static_cast<double>(b) + 0.5) * width_);
    table.columns.push_back(std::move(middles));
    correlation_.put(table, "g6", "");
    note_lower_bounds(found, correlation_.has_lower_bounds());
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(correlation_, local_, local_square_, global_, global_square_);
  }

 private:
  double range_;
  BlockedColumn correlation_;
  double width_;
  Blocking local_, local_square_, global_, global_square_;
};

}  // namespace

MadeObservable make_hexatic(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Hexatic>(request, run);
}

}  // namespace carom
