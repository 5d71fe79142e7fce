// Regular starts: the rows and columns that leave the widest spacing for the number of disks.

#include "simulation/start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace carom {

namespace {

/// Positions of n lines across the box along one axis: a line per period, or the whole way from wall to wall.
struct Lines {
  double first;
  double step;
};

/// `n` lines, with room for each second row to be moved by half a step where `staggered`.
Lines lines_across(const Box& box, int axis, std::int64_t n, double diameter, bool staggered) {
  const double length = box.lengths()[axis];
  const double number = static_cast<double>(n);
  if (box.periodic(axis)) {
    const double step = length / number;
    return {box.lower[axis] + (staggered ? 0.25 : 0.5) * step, step};
  }
  const double gaps = number - (staggered ? 0.5 : 1.0);
  // As much room to the walls as between disks: surfaces are `clear` apart everywhere.
  const double clear = (length - diameter * (gaps + 1.0)) / (gaps + 2.0);
  if (clear >= 0.0 || gaps <= 0.0) return {box.lower[axis] + 0.5 * diameter + clear, diameter + clear};
  return {box.lower[axis] + 0.5 * diameter, (length - diameter) / gaps};  // tight: the outer disks touch the walls
}

/// Rows of `per_row` sites along axis `along`, each second row moved by half a step where there are several and the
/// lattice is staggered.
struct Grid {
  int along = 0;
  std::int64_t per_row = 1;
  std::int64_t rows = 1;
  bool staggered = false;

  [[nodiscard]] Lines within_row(const Box& box, double diameter) const {
    return lines_across(box, along, per_row, diameter, staggered);
  }
  [[nodiscard]] Lines across_rows(const Box& box, double diameter) const {
    return lines_across(box, 1 - along, rows, diameter, false);
  }

  /// The smallest distance of two sites or of a site and its own image; where there is one site alone, as far as the box
  /// is long.
  [[nodiscard]] double spacing(const Box& box, double diameter) const {
    const double dx = within_row(box, diameter).step;
    const double dy = across_rows(box, diameter).step;
    const bool wraps = box.periodic(1 - along);
    double nearest = box.lengths().maxCoeff();
    if (per_row > 1 || box.periodic(along)) nearest = std::min(nearest, dx);
    if (!staggered && (rows > 1 || wraps)) nearest = std::min(nearest, dy);
    if (staggered) nearest = std::min(nearest, std::hypot(0.5 * dx, dy));
    if (staggered && (rows > 2 || wraps)) nearest = std::min(nearest, 2.0 * dy);  // rows that are moved alike
    return nearest;
  }
};

/// The grid with the widest spacing that has room for `count` disks.
Grid widest(const Box& box, std::int64_t count, double diameter, bool hexagonal) {
  Grid best;
  double best_spacing = -std::numeric_limits<double>::infinity();
  for (int along = 0; along < (hexagonal ? 2 : 1); ++along) {
    for (std::int64_t per_row = 1; per_row <= count; ++per_row) {
      Grid grid{along, per_row, (count + per_row - 1) / per_row, false};
      grid.staggered = hexagonal && grid.rows > 1;
      if (grid.staggered && box.periodic(1 - along) && grid.rows % 2 == 1) ++grid.rows;  // rows alternate, round the period too
      const double spacing = grid.spacing(box, diameter);
      if (spacing <= best_spacing) continue;
      best_spacing = spacing;
      best = grid;
    }
  }
  return best;
}

Lattice lattice(const Box& box, std::int64_t count, double diameter, bool hexagonal) {
  Lattice result;
  result.sites.resize(2, count);
  if (count == 0) return result;
  const Grid grid = widest(box, count, diameter, hexagonal);
  result.spacing = grid.spacing(box, diameter);
  const Lines x = grid.within_row(box, diameter);
  const Lines y = grid.across_rows(box, diameter);
  const std::int64_t sites = grid.per_row * grid.rows;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t site = k * sites / count;  // sites that stay empty are spread evenly
    const std::int64_t row = site / grid.per_row;
    const double column = static_cast<double>(site % grid.per_row) + (grid.staggered && row % 2 == 1 ? 0.5 : 0.0);
    result.sites(grid.along, k) = x.first + column * x.step;
    result.sites(1 - grid.along, k) = y.first + static_cast<double>(row) * y.step;
  }
  return result;
}

/// Calls visit(x, y) for the sites of a lattice of spacing 1 round (0, 0), moved by (left, down), within `reach`.
template <class Visit>
void visit_round_sites(bool hexagonal, double left, double down, double reach, Visit&& visit) {
  const double between_rows = hexagonal ? std::sqrt(0.75) : 1.0;
  for (double row = std::ceil((down - reach) / between_rows); row * between_rows <= down + reach; row += 1.0) {
    const double y = row * between_rows - down;
    const double half = std::sqrt(std::max(0.0, reach * reach - y * y));
    const double shift = hexagonal && std::fmod(row, 2.0) != 0.0 ? 0.5 : 0.0;
    visit(std::ceil(left - shift - half), std::floor(left - shift + half), shift - left, y);
  }
}

/// The sites of a lattice in a circle: of lattices with a site, the middle of a cell or the middle of an edge in the centre, the
/// one with the widest spacing of which enough sites fit; of these, those nearest to the centre.
Lattice round_lattice(const Box& box, std::int64_t count, double diameter, bool hexagonal) {
  Lattice result;
  result.sites.resize(2, count);
  if (count == 0) return result;
  const Eigen::Vector2d centre = box.lower + 0.5 * box.lengths();
  const double reach = 0.5 * (box.lengths().x() - diameter) * (1.0 + 1e-12);  // of the centres of disks
  const auto fitting = [&](const Eigen::Vector2d& origin, double spacing) {
    double sites = 0.0;
    visit_round_sites(hexagonal, origin.x(), origin.y(), reach / spacing,
                      [&](double first, double last, double, double) { sites += std::max(0.0, last - first + 1.0); });
    return static_cast<std::int64_t>(sites);
  };
  const Eigen::Vector2d cell(0.5, hexagonal ? std::sqrt(1.0 / 12.0) : 0.5);
  Eigen::Vector2d best(0.0, 0.0);
  for (const Eigen::Vector2d& origin : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.5, 0.0), cell}) {
    double fits = 2.0 * box.lengths().x();
    while (fitting(origin, fits) < count) fits *= 0.995;
    for (double low = fits, high = fits / 0.995; high - low > 1e-13 * high;) {
      const double middle = 0.5 * (low + high);
      if (!(middle > low && middle < high)) break;
      (fitting(origin, middle) >= count ? low : high) = middle;
      fits = low;
    }
    if (fits > result.spacing) result.spacing = fits, best = origin;
  }
  std::vector<Eigen::Vector2d> sites;
  visit_round_sites(hexagonal, best.x(), best.y(), reach / result.spacing,
                    [&](double first, double last, double shift, double y) {
                      for (double k = first; k <= last; k += 1.0) sites.emplace_back(k + shift, y);
                    });
  std::stable_sort(sites.begin(), sites.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.squaredNorm() < b.squaredNorm() * (1.0 - 1e-12);
  });
  for (std::int64_t k = 0; k < count; ++k) result.sites.col(k) = centre + result.spacing * sites[static_cast<std::size_t>(k)];
  return result;
}

Lattice any_lattice(const Box& box, std::int64_t count, double diameter, bool hexagonal) {
  return box.is_circle ? round_lattice(box, count, diameter, hexagonal) : lattice(box, count, diameter, hexagonal);
}

}  // namespace

Lattice square_lattice(const Box& box, std::int64_t count, double diameter) { return any_lattice(box, count, diameter, false); }

Lattice hexagonal_lattice(const Box& box, std::int64_t count, double diameter) { return any_lattice(box, count, diameter, true); }

}  // namespace carom
