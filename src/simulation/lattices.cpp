// Regular starts: the rows and columns that leave the widest spacing for the number of disks.

#include "simulation/start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace

Lattice square_lattice(const Box& box, std::int64_t count, double diameter) { return lattice(box, count, diameter, false); }

Lattice hexagonal_lattice(const Box& box, std::int64_t count, double diameter) { return lattice(box, count, diameter, true); }

}  // namespace carom
