// One grid of cells for each power of two of the radius: however different the sizes are, a cell as wide as its largest
// diameter holds few disks that do not overlap. Each disk looks into the grids of its own and of all larger sizes.

#include "scene/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace carom::detail {
namespace {

class Grid {
 public:
  Grid(const Box& box, double largest_radius) : box_(box), largest_radius_(largest_radius) {
    for (int axis = 0; axis < 2; ++axis) {
      // Keys hold 32 bits per axis; a coarser grid than necessary is only slower.
      constexpr double most_cells = 1 << 30;
      cells_[axis] =
          static_cast<std::int64_t>(std::clamp(std::floor(box.lengths()[axis] / (2.0 * largest_radius)), 1.0, most_cells));
      width_[axis] = box.lengths()[axis] / static_cast<double>(cells_[axis]);
    }
  }

  [[nodiscard]] double largest_radius() const { return largest_radius_; }
  [[nodiscard]] const std::vector<std::pair<std::uint64_t, std::uint32_t>>& entries() const { return entries_; }

  void add(std::uint32_t disk, const Eigen::Vector2d& centre) {
    entries_.emplace_back(key(cell(centre, 0), cell(centre, 1)), disk);
  }

  void sort() { std::sort(entries_.begin(), entries_.end()); }

  /// Calls visit(disk) for all disks in the cells within `reach` of `centre`, until it returns true. Returns whether it did.
  template <class Visit>
  bool any_near(const Eigen::Vector2d& centre, double reach, const Visit& visit) const {
    const auto [left, right] = range(centre[0], reach, 0);
    const auto [bottom, top] = range(centre[1], reach, 1);
    for (std::int64_t row = bottom; row <= top; ++row) {
      const std::int64_t y = wrapped(row, 1);
      for (std::int64_t begin = left; begin <= right;) {  // a row that crosses the edge is two runs of cells
        const std::int64_t x = wrapped(begin, 0);
        const std::int64_t length = std::min(right - begin + 1, cells_[0] - x);
        auto entry = std::lower_bound(entries_.begin(), entries_.end(), std::pair(key(x, y), std::uint32_t{0}));
        for (; entry != entries_.end() && entry->first <= key(x + length - 1, y); ++entry) {
          if (visit(entry->second)) return true;
        }
        begin += length;
      }
    }
    return false;
  }

 private:
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(y) << 32U | static_cast<std::uint64_t>(x);
  }

  [[nodiscard]] std::int64_t wrapped(std::int64_t index, int axis) const {
    return index < 0 ? index + cells_[axis] : index >= cells_[axis] ? index - cells_[axis] : index;
  }

  [[nodiscard]] std::int64_t index(double coordinate, int axis) const {
    return static_cast<std::int64_t>(std::floor((coordinate - box_.lower[axis]) / width_[axis]));
  }

  [[nodiscard]] std::int64_t cell(const Eigen::Vector2d& centre, int axis) const {
    return std::clamp(index(centre[axis], axis), std::int64_t{0}, cells_[axis] - 1);
  }

  /// First and last cell within reach, unwrapped on a periodic axis; no cell twice.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> range(double coordinate, double reach, int axis) const {
    const std::int64_t last = cells_[axis] - 1;
    const std::int64_t low = index(coordinate - reach, axis);
    const std::int64_t high = index(coordinate + reach, axis);
    if (!box_.periodic(axis)) return {std::clamp(low, std::int64_t{0}, last), std::clamp(high, std::int64_t{0}, last)};
    return high - low >= last ? std::pair(std::int64_t{0}, last) : std::pair(low, high);
  }

  const Box& box_;
  double largest_radius_;
  Eigen::Matrix<std::int64_t, 2, 1> cells_;
  Eigen::Vector2d width_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries_;  ///< cell key, disk
};

double distance(const Box& box, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Eigen::Vector2d separation = a - b;
  for (int axis = 0; axis < 2; ++axis) {
    const double length = box.lengths()[axis];
    if (box.periodic(axis)) separation[axis] -= length * std::round(separation[axis] / length);
  }
  return std::hypot(separation[0], separation[1]);
}

}  // namespace

std::optional<Overlap> find_overlap(const Box& box, std::span<const Eigen::Vector2d> centres, std::span<const double> radii,
                                    double tolerance) {
  std::map<int, double, std::greater<>> largest;  // largest radius of each power of two, large disks first
  for (const double radius : radii) {
    double& known = largest[std::ilogb(radius)];
    known = std::max(known, radius);
  }
  std::map<int, Grid, std::greater<>> grids;
  for (const auto& [power, radius] : largest) grids.emplace(power, Grid(box, radius));
  for (std::size_t i = 0; i < centres.size(); ++i) {
    grids.at(std::ilogb(radii[i])).add(static_cast<std::uint32_t>(i), centres[i]);
  }
  for (auto& [power, grid] : grids) grid.sort();

  std::optional<Overlap> found;
  // Each size is searched for overlaps of its own before smaller disks look into it: cells stay short that way.
  for (auto larger = grids.begin(); larger != grids.end(); ++larger) {
    for (auto smaller = larger; smaller != grids.end(); ++smaller) {
      for (const auto& entry : smaller->second.entries()) {
        const std::size_t i = entry.second;
        const auto overlaps = [&](std::size_t j) {
          const double contact = radii[i] + radii[j];
          if (i == j) return false;
          const double apart = distance(box, centres[i], centres[j]);
          if (!(apart < contact * (1.0 - tolerance))) return false;
          found = Overlap{std::min(i, j), std::max(i, j), contact - apart, contact};
          return true;
        };
        if (larger->second.any_near(centres[i], radii[i] + larger->second.largest_radius(), overlaps)) return found;
      }
    }
  }
  return std::nullopt;
}

}  // namespace carom::detail
