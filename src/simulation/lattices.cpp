// Regular starts: the rows and columns that leave the widest spacing for the number of disks.

#include "simulation/start.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Positions of n lines across the box along one axis: a line per period, or the whole way from wall to wall.
struct Lines {
  double first;
  double step;
};

/// `n` lines of which each second one is moved by half a step where `staggered`.
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

double spacing_of(const Box& box, std::int64_t columns, std::int64_t rows, double diameter, bool staggered) {
  const double dx = lines_across(box, 0, columns, diameter, staggered).step;
  const double dy = lines_across(box, 1, rows, diameter, false).step;
  const double far = std::max(box.lengths()[0], box.lengths()[1]);
  const double along = columns > 1 || box.periodic(0) ? dx : far;
  const double across = rows > 1 || box.periodic(1) ? dy : far;
  if (!staggered) return std::min(along, across);
  const double oblique = rows > 1 || box.periodic(1) ? std::hypot(0.5 * dx, dy) : far;
  const double second_row = rows > 2 || box.periodic(1) ? 2.0 * dy : far;
  return std::min({along, oblique, second_row});
}

Lattice lattice(const Box& box, std::int64_t count, double diameter, bool staggered) {
  Lattice best;
  best.sites.resize(2, count);
  if (count == 0) return best;
  std::int64_t columns = 1;
  std::int64_t rows = count;
  for (std::int64_t c = 1; c <= count; ++c) {
    std::int64_t r = (count + c - 1) / c;
    if (staggered && box.periodic(1) && r % 2 == 1) ++r;  // rows alternate, round the period too
    const double spacing = spacing_of(box, c, r, diameter, staggered);
    if (spacing > best.spacing) {
      best.spacing = spacing;
      columns = c;
      rows = r;
    }
  }
  const Lines x = lines_across(box, 0, columns, diameter, staggered);
  const Lines y = lines_across(box, 1, rows, diameter, false);
  const std::int64_t sites = columns * rows;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t site = k * sites / count;  // sites that stay empty are spread evenly
    const std::int64_t row = site / columns;
    const double column = static_cast<double>(site % columns) + (staggered && row % 2 == 1 ? 0.5 : 0.0);
    best.sites.col(k) << x.first + column * x.step, y.first + static_cast<double>(row) * y.step;
  }
  return best;
}

}  // namespace

Lattice square_lattice(const Box& box, std::int64_t count, double diameter) { return lattice(box, count, diameter, false); }

Lattice hexagonal_lattice(const Box& box, std::int64_t count, double diameter) { return lattice(box, count, diameter, true); }

}  // namespace carom
