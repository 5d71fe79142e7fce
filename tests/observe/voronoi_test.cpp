// Voronoi cells against polygons that are cut by one half-plane after the other, lattices whose cells are known, and the cells of
// an ideal gas.

#include "observe/observed_system.hpp"

#include "observe/voronoi_cells.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace carom::test {
namespace {

/// A polygon, whose side from corner k to the next belongs to neighbour k: -1 for a wall.
struct CutCell {
  std::vector<Eigen::Vector2d> corners;
  std::vector<std::int32_t> neighbours;
  std::vector<Eigen::Vector2d> to;

  /// Keeps what is nearer to the origin than to `there`.
  void cut(std::int32_t neighbour, const Eigen::Vector2d& there) {
    CutCell left;
    const auto beyond = [&](const Eigen::Vector2d& corner) { return corner.dot(there) - 0.5 * there.squaredNorm(); };
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d &a = corners[k], &b = corners[(k + 1) % corners.size()];
      const double at_a = beyond(a), at_b = beyond(b);
      const Eigen::Vector2d crossing = a + at_a / (at_a - at_b) * (b - a);
      if (at_a <= 0.0) left.add(a, neighbours[k], to[k]);
      if (at_a <= 0.0 && at_b > 0.0) left.add(crossing, neighbour, there);
      if (at_a > 0.0 && at_b <= 0.0) left.add(crossing, neighbours[k], to[k]);
    }
    *this = left;
  }
  void add(const Eigen::Vector2d& corner, std::int32_t neighbour, const Eigen::Vector2d& there) {
    corners.push_back(corner), neighbours.push_back(neighbour), to.push_back(there);
  }
  [[nodiscard]] double length(std::size_t k) const { return (corners[(k + 1) % corners.size()] - corners[k]).norm(); }
  [[nodiscard]] double perimeter() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) sum += length(k);
    return sum;
  }
  [[nodiscard]] double area() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d &a = corners[k], &b = corners[(k + 1) % corners.size()];
      sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    return sum;
  }
  [[nodiscard]] bool at_wall() const { return std::find(neighbours.begin(), neighbours.end(), -1) != neighbours.end(); }
  [[nodiscard]] std::complex<double> psi6() const {
    std::complex<double> sum = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) sum += std::polar(length(k), 6.0 * std::atan2(to[k].y(), to[k].x()));
    return sum / perimeter();
  }
};

/// The cells of a circular box are cut out of a polygon of so many corners on the circle. What is between a side of it and its
/// arc is added to a cell, so that areas are too small by some (2 pi / corners)^3 of the circle at each end of an arc.
constexpr int corners_of_circles = 20'000;

std::vector<CutCell> cut_cells_in_circle(const Box& box, const Eigen::Matrix2Xd& positions) {
  const Eigen::Vector2d centre = 0.5 * (box.lower + box.upper);
  const double radius = 0.5 * box.lengths().x();
  std::vector<CutCell> cells;
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    CutCell cell;
    for (int k = 0; k < corners_of_circles; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / corners_of_circles;
      const Eigen::Vector2d corner = centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)) - positions.col(i);
      cell.add(corner, -1, corner);
    }
    for (Eigen::Index j = 0; j < positions.cols(); ++j)
      if (j != i) cell.cut(static_cast<std::int32_t>(j), positions.col(j) - positions.col(i));
    cells.push_back(cell);
  }
  return cells;
}

/// Returns the area of a cell that is cut out of a polygon on a circle, with what is between polygon and circle.
double area_with_arcs(const CutCell& cell, double radius) {
  double area = cell.area();
  for (std::size_t k = 0; k < cell.neighbours.size(); ++k) {
    if (cell.neighbours[k] >= 0) continue;
    const double angle = 2.0 * std::asin(0.5 * cell.length(k) / radius);
    area += 0.5 * radius * radius * (angle - std::sin(angle));
  }
  return area;
}

/// In a sheared box the images of so many boxes above and below cut, and of each those that are near in x.
std::vector<CutCell> cut_cells(const Box& box, const Eigen::Matrix2Xd& positions, double displacement = 0.0, int rows = 3) {
  const int reach = displacement == 0.0 || rows > 3 ? 3 : 6;
  if (box.is_circle) return cut_cells_in_circle(box, positions);
  std::vector<CutCell> cells;
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    CutCell cell;
    const Eigen::Vector2d self = positions.col(i), far = (rows > 3 ? rows : 2.0) * box.lengths();
    const Eigen::Vector2d low(box.periodic(0) ? -far.x() : box.lower.x() - self.x(),
                              box.periodic(1) ? -far.y() : box.lower.y() - self.y());
    const Eigen::Vector2d high(box.periodic(0) ? far.x() : box.upper.x() - self.x(),
                               box.periodic(1) ? far.y() : box.upper.y() - self.y());
    cell.add(low, -1, {0.0, 2.0 * low.y()});
    cell.add({high.x(), low.y()}, -1, {2.0 * high.x(), 0.0});
    cell.add(high, -1, {0.0, 2.0 * high.y()});
    cell.add({low.x(), high.y()}, -1, {2.0 * low.x(), 0.0});
    for (int y = box.periodic(1) ? -rows : 0; y <= (box.periodic(1) ? rows : 0); ++y) {
      const int back = rows > 3 ? static_cast<int>(std::lround(y * displacement / box.lengths().x())) : 0;
      for (int x = box.periodic(0) ? -reach - back : 0; x <= (box.periodic(0) ? reach - back : 0); ++x)
        for (Eigen::Index j = 0; j < positions.cols(); ++j) {
          if (j == i && x == 0 && y == 0) continue;
          const Eigen::Vector2d shift(x * box.lengths().x() + y * displacement, y * box.lengths().y());
          cell.cut(static_cast<std::int32_t>(j), positions.col(j) - self + shift);
        }
    }
    cells.push_back(cell);
  }
  return cells;
}

Eigen::Matrix2Xd random_points(const Box& box, Eigen::Index count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  Eigen::Matrix2Xd positions(2, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double x = uniform(), y = uniform();
    positions.col(i) = box.lower + box.lengths().cwiseProduct(Eigen::Vector2d(x, y));
  }
  return positions;
}

void expect_cells_by_cutting(const Box& box, const Eigen::Matrix2Xd& positions, double displacement = 0.0, int rows = 3) {
  constexpr double rounding = 1e-9;  // corners are far away where centres are nearly on a line
  const VoronoiCells cells(box, positions, displacement);
  const std::vector<CutCell> twins = cut_cells(box, positions, displacement, rows);
  ASSERT_EQ(cells.count(), twins.size());
  for (std::size_t i = 0; i < twins.size(); ++i) {
    EXPECT_NEAR(cells.area(i), twins[i].area(), rounding * box.area());
    EXPECT_EQ(cells.at_wall(i), twins[i].at_wall());
    ASSERT_EQ(cells.sides(i).size(), twins[i].corners.size()) << "disk " << i << " of " << positions.cols();
    for (const VoronoiSide& side : cells.sides(i)) {
      const auto& to = twins[i].to;
      const auto same = std::find_if(to.begin(), to.end(),
                                     [&](const auto& there) { return (there - side.to).norm() < 1e-12 * box.lengths().norm(); });
      ASSERT_NE(same, to.end());
      const auto k = static_cast<std::size_t>(same - to.begin());
      EXPECT_EQ(side.neighbour, twins[i].neighbours[k]);
      EXPECT_NEAR(side.length, twins[i].length(k), rounding * box.lengths().norm());
    }
  }
}

TEST(VoronoiCells, AreThoseThatOneCutAfterTheOtherLeaves) {
  for (const Boundary x : {Boundary::periodic, Boundary::walls})
    for (const Boundary y : {Boundary::periodic, Boundary::walls})
      for (const Eigen::Index count : {1, 2, 3, 7, 40}) {
        if (count == 1 && x == Boundary::periodic && y == x) continue;  // a rectangular lattice, see below
        const Box box{{-2.0, 1.0}, {3.0, 4.5}, {x, y}};
        expect_cells_by_cutting(box, random_points(box, count, static_cast<std::uint64_t>(count)));
      }
  const Box narrow{{0.0, 0.0}, {30.0, 1.0}, {Boundary::periodic, Boundary::walls}};
  expect_cells_by_cutting(narrow, random_points(narrow, 25, 9));
}

TEST(VoronoiCells, OfAShearedBoxAreThoseOfImagesThatAreDisplaced) {
  const Box box{{-2.0, 1.0}, {3.0, 4.5}, {Boundary::periodic, Boundary::periodic}};
  for (const double displacement : {0.3, 2.6, 4.999, -1.7})
    for (const Eigen::Index count : {1, 2, 3, 7, 40})
      expect_cells_by_cutting(box, random_points(box, count, static_cast<std::uint64_t>(count)), displacement);
}

/// Returns points in the first tenth of a box along x.
Eigen::Matrix2Xd gathered_points(const Box& box, Eigen::Index count, std::uint64_t seed) {
  Box tenth = box;
  tenth.upper.x() = box.lower.x() + 0.1 * box.lengths().x();
  return random_points(tenth, count, seed);
}

/// Circles around corners in the gap are far larger than the box is high.
TEST(VoronoiCells, OfFlatBoxesWithAGapAreThoseThatOneCutAfterTheOtherLeaves) {
  for (const Boundary x : {Boundary::periodic, Boundary::walls})
    for (const Boundary y : {Boundary::periodic, Boundary::walls})
      for (const Eigen::Index count : {2, 7, 60}) {
        const Box box{{-2.0, 1.0}, {998.0, 4.0}, {x, y}};
        expect_cells_by_cutting(box, gathered_points(box, count, static_cast<std::uint64_t>(count)));
      }
}

TEST(VoronoiCells, OfShearedFlatBoxesWithAGapAreThoseOfImagesThatAreDisplaced) {
  const Box box{{-2.0, 1.0}, {298.0, 4.0}, {Boundary::periodic, Boundary::periodic}};
  for (const double displacement : {0.1, 10.7, 121.3, 299.2, -77.7})
    for (const Eigen::Index count : {1, 2, 12})
      expect_cells_by_cutting(box, gathered_points(box, count, static_cast<std::uint64_t>(count)), displacement, 120);
}

/// With images in all directions as far as the gap is wide there would be billions of them.
TEST(VoronoiCells, OfExtremelyFlatBoxesTakeNoLongerThanOthers) {
  for (const double displacement : {0.0, 0.3, 1234.5, 4e5})
    for (const int upright : {0, 1}) {
      Box box{{0.0, 0.0}, {1e6, 3.0}, {Boundary::periodic, Boundary::periodic}};
      Eigen::Matrix2Xd positions = gathered_points(box, 80, 1);
      if (upright == 1) std::swap(box.upper.x(), box.upper.y()), positions.row(0).swap(positions.row(1));
      const VoronoiCells cells(box, positions, upright == 1 ? 1e-6 * displacement : displacement);
      double area = 0.0;
      for (std::size_t i = 0; i < cells.count(); ++i) area += cells.area(i);
      EXPECT_NEAR(area, box.area(), 1e-6 * box.area()) << displacement;
    }
}

/// A displacement of whole box lengths displaces nothing.
TEST(VoronoiCells, OfABoxShearedByItsLengthAreThoseOfTheBoxAtRest) {
  const Box box{{-2.0, 1.0}, {3.0, 4.5}, {Boundary::periodic, Boundary::periodic}};
  const Eigen::Matrix2Xd positions = random_points(box, 40, 5);
  const VoronoiCells at_rest(box, positions);
  for (const double displacement : {0.0, 5.0, -10.0}) {
    const VoronoiCells cells(box, positions, displacement);
    for (std::size_t i = 0; i < cells.count(); ++i) {
      ASSERT_EQ(cells.sides(i).size(), at_rest.sides(i).size());
      for (std::size_t k = 0; k < cells.sides(i).size(); ++k) {
        EXPECT_EQ(cells.sides(i)[k].neighbour, at_rest.sides(i)[k].neighbour);
        EXPECT_NEAR(cells.sides(i)[k].length, at_rest.sides(i)[k].length, 1e-12);
      }
      EXPECT_NEAR(cells.area(i), at_rest.area(i), 1e-12);
    }
  }
}

/// The first and the last number below an edge are rounded to the edge itself on a coarser grid.
TEST(VoronoiCells, OfCentresAtTheEdgesOfTheBoxAreWhole) {
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::periodic}};
  Eigen::Matrix2Xd positions = random_points(box, 12, 3);
  positions.col(0) = Eigen::Vector2d(0.0, 0.4);
  positions.col(1) = Eigen::Vector2d(std::nextafter(1.0, 0.0), 0.7);
  positions.col(2) = Eigen::Vector2d(0.3, std::nextafter(1.0, 0.0));
  expect_cells_by_cutting(box, positions);
}

/// Points of a lattice with these two vectors and a basis.
Eigen::Matrix2Xd lattice(Box& box, const std::vector<Eigen::Vector2d>& basis, const Eigen::Vector2d& cell, int across, int up) {
  box = {{0.0, 0.0}, {cell.x() * across, cell.y() * up}, {Boundary::periodic, Boundary::periodic}};
  Eigen::Matrix2Xd positions(2, static_cast<Eigen::Index>(basis.size()) * across * up);
  Eigen::Index at = 0;
  for (int x = 0; x < across; ++x)
    for (int y = 0; y < up; ++y)
      for (const Eigen::Vector2d& one : basis)
        positions.col(at++) = Eigen::Vector2d((x + one.x()) * cell.x(), (y + one.y()) * cell.y());
  return positions;
}

std::complex<double> psi6(const VoronoiCells& cells, std::size_t i) {
  std::complex<double> sum = 0.0;
  double perimeter = 0.0;
  for (const VoronoiSide& side : cells.sides(i)) {
    sum += std::polar(side.length, 6.0 * std::atan2(side.to.y(), side.to.x()));
    perimeter += side.length;
  }
  return sum / perimeter;
}

/// Corners of square and honeycomb lattices belong to four and six cells: which of them are neighbours is a choice, sides are
/// not.
TEST(VoronoiCells, OfLatticesAreKnown) {
  struct Known {
    std::vector<Eigen::Vector2d> basis;
    Eigen::Vector2d cell;
    std::size_t sides;  ///< with a length
    double psi6, side;  ///< length of a side, in roots of the cell's area
  };
  const double root3 = std::sqrt(3.0);
  const std::vector<Known> all = {{{{0.1, 0.1}, {0.6, 0.6}}, {1.0, root3}, 6, 1.0, std::sqrt(2.0 / (3.0 * root3))},
                                  {{{0.1, 0.1}}, {1.0, 1.0}, 4, 0.0, 1.0},
                                  {{{0.0, 0.05}, {0.5, 0.05 + 1.0 / 6.0}, {0.5, 0.55}, {0.0, 0.55 + 1.0 / 6.0}},
                                   {root3, 3.0},
                                   3,
                                   1.0,
                                   std::sqrt(4.0 / root3)}};
  for (const Known& known : all)
    for (const int size : {1, 2, 3, 12}) {
      Box box;
      const Eigen::Matrix2Xd positions = lattice(box, known.basis, known.cell, size, size + 1);
      const VoronoiCells cells(box, positions);
      const double area = box.area() / static_cast<double>(cells.count());
      std::ptrdiff_t charge = 0;
      for (std::size_t i = 0; i < cells.count(); ++i) {
        const auto sides = cells.sides(i);
        charge += 6 - static_cast<std::ptrdiff_t>(sides.size());
        EXPECT_NEAR(cells.area(i), area, 1e-12);
        EXPECT_NEAR(std::abs(psi6(cells, i)), known.psi6, 1e-7);
        EXPECT_EQ(std::count_if(sides.begin(), sides.end(), [](const VoronoiSide& side) { return side.length > 1e-6; }),
                  known.sides);
        for (const VoronoiSide& side : sides) {
          if (side.length > 1e-6) {
            EXPECT_NEAR(side.length, known.side * std::sqrt(area), 1e-7);
          }
        }
      }
      EXPECT_EQ(charge, 0) << known.sides << " sides, " << size;
    }
}

/// A square lattice that is sheared by g is one of the vectors a = (1, 0) and b = (g, 1). For 0 < g < 1 the triangle of a, b and
/// b - a is acute, and the side towards a neighbour is as long as the way there times the cotangent of the angle opposite to it:
/// 1 - g + g^2, |b| (1 - g) and |b - a| g.
TEST(VoronoiCells, OfAShearedLatticeAreKnown) {
  for (const double g : {0.125, 0.25, 0.5, 0.75, 0.8125})
    for (const int size : {1, 2, 3, 12}) {
      Box box;
      Eigen::Matrix2Xd positions = lattice(box, {{0.25, 0.25}}, {1.0, 1.0}, size, size + 1);
      for (Eigen::Index i = 0; i < positions.cols(); ++i)
        positions(0, i) = std::fmod(positions(0, i) + g * positions(1, i), box.upper.x());
      const VoronoiCells cells(box, positions, std::fmod(g * box.upper.y(), box.upper.x()));
      for (std::size_t i = 0; i < cells.count(); ++i) {
        EXPECT_NEAR(cells.area(i), 1.0, 1e-13);
        ASSERT_EQ(cells.sides(i).size(), 6U) << g << ", " << size;
        for (const VoronoiSide& side : cells.sides(i)) {
          const Eigen::Vector2d to = side.to.y() < -0.5 ? Eigen::Vector2d(-side.to) : side.to;
          const bool is_a = std::abs(to.y()) < 0.5, is_b = !is_a && to.x() > 0.0;
          const Eigen::Vector2d known =
              is_a ? Eigen::Vector2d(to.x() > 0.0 ? 1.0 : -1.0, 0.0) : Eigen::Vector2d(is_b ? g : g - 1.0, 1.0);
          EXPECT_NEAR((to - known).norm(), 0.0, 1e-14);
          EXPECT_NEAR(side.length, is_a ? 1.0 - g + g * g : known.norm() * (is_b ? 1.0 - g : g), 1e-13);
        }
      }
    }
}

/// E[A^2] of the cell of a point among others of density 1 (Gilbert, Ann. Math. Stat. 33, 958 (1962)): x and y are both nearer to
/// the point than to any other with the probability exp(-U), U the area of the discs around x and y through the point.
double square_of_poisson_areas() {
  constexpr int parts = 400;
  double sum = 0.0;
  for (int p = 0; p < parts; ++p)
    for (int k = 0; k < parts; ++k) {  // |x| = 1, |y| = t < 1; scale and the other order follow
      const double angle = std::numbers::pi * (p + 0.5) / parts, t = (k + 0.5) / parts;
      const double d = std::sqrt(1.0 + t * t - 2.0 * t * std::cos(angle));
      const double a = std::acos((1.0 + d * d - t * t) / (2.0 * d)), b = std::acos((t * t + d * d - 1.0) / (2.0 * t * d));
      const double joined = std::numbers::pi * (1.0 + t * t) - (a + t * t * b - t * std::sin(angle));
      sum += t / (2.0 * joined * joined);
    }
  return 8.0 * std::numbers::pi * std::numbers::pi * sum / parts / parts;
}

TEST(VoronoiCells, OfAnIdealGasHaveItsMoments) {
  constexpr int parts = 20;
  double squares = 0.0, of_squares = 0.0, sides = 0.0, of_sides = 0.0, perimeters = 0.0, of_perimeters = 0.0;
  for (int part = 0; part < parts; ++part) {
    const Box box{{0.0, 0.0}, {50.0, 40.0}, {Boundary::periodic, Boundary::periodic}};
    const VoronoiCells cells(box, random_points(box, 2000, 100 + static_cast<std::uint64_t>(part)));
    double area = 0.0, charge = 0.0, square = 0.0, side = 0.0, perimeter = 0.0;
    for (std::size_t i = 0; i < cells.count(); ++i) {
      const double z = static_cast<double>(cells.sides(i).size());
      area += cells.area(i), charge += 6.0 - z;
      square += cells.area(i) * cells.area(i) / 2000.0;
      side += (z - 6.0) * (z - 6.0) / 2000.0;
      for (const VoronoiSide& one : cells.sides(i)) perimeter += one.length / 2000.0;
    }
    EXPECT_NEAR(area, box.area(), 1e-9);
    EXPECT_EQ(charge, 0.0);
    squares += square / parts, of_squares += square * square / parts;
    sides += side / parts, of_sides += side * side / parts;
    perimeters += perimeter / parts, of_perimeters += perimeter * perimeter / parts;
  }
  const auto error = [](double mean, double square) { return std::sqrt((square - mean * mean) / (parts - 1)); };
  EXPECT_NEAR(square_of_poisson_areas(), 1.280176, 1e-4) << "Gilbert's number";
  // The number of points is fixed, which lowers <A^2> by a relative 1/N.
  EXPECT_NEAR(squares, square_of_poisson_areas(), 4.0 * error(squares, of_squares));
  EXPECT_NEAR(sides, 1.7808116990, 4.0 * error(sides, of_sides)) << "Brakke (1986)";
  EXPECT_NEAR(perimeters, 4.0, 4.0 * error(perimeters, of_perimeters)) << "Meijering (1953)";
}

TEST(VoronoiCells, OfDisksAtOnePlaceAreRefused) {
  Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::periodic}};
  EXPECT_THROW(VoronoiCells(box, Eigen::Matrix2Xd::Constant(2, 2, 0.5)), std::invalid_argument);
  box = {box.lower, box.upper, {Boundary::walls, Boundary::walls}, true};
  EXPECT_THROW(VoronoiCells(box, Eigen::Matrix2Xd::Constant(2, 2, 0.5)), std::invalid_argument);
}

const Box circle_of_cells{{-2.0, 1.0}, {3.0, 6.0}, {Boundary::walls, Boundary::walls}, true};

Eigen::Matrix2Xd random_points_in_circle(Eigen::Index count, std::uint64_t seed) {
  const Eigen::Matrix2Xd all = random_points(circle_of_cells, 3 * count + 20, seed);
  Eigen::Matrix2Xd positions(2, count);
  const Eigen::Vector2d centre = 0.5 * (circle_of_cells.lower + circle_of_cells.upper);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < all.cols() && kept < count; ++i)
    if ((all.col(i) - centre).norm() < 2.5) positions.col(kept++) = all.col(i);
  EXPECT_EQ(kept, count);
  return positions;
}

TEST(VoronoiCells, InACircleAreThoseThatOneCutAfterTheOtherLeaves) {
  const double circle = circle_of_cells.area(), rounding = 1e-9 * circle;
  for (const Eigen::Index count : {1, 2, 3, 7, 40}) {
    SCOPED_TRACE(count);
    const Eigen::Matrix2Xd positions = random_points_in_circle(count, static_cast<std::uint64_t>(count));
    const VoronoiCells cells(circle_of_cells, positions);
    const std::vector<CutCell> twins = cut_cells(circle_of_cells, positions);
    ASSERT_EQ(cells.count(), twins.size());
    for (std::size_t i = 0; i < twins.size(); ++i) {
      EXPECT_NEAR(cells.area(i), area_with_arcs(twins[i], 2.5), rounding) << i;
      EXPECT_EQ(cells.at_wall(i), twins[i].at_wall()) << i;
      double at_rim = 0.0;
      for (const VoronoiSide& side : cells.sides(i)) {
        if (side.neighbour < 0) {
          at_rim += side.length;
          continue;
        }
        const auto& others = twins[i].neighbours;
        const auto same = std::find(others.begin(), others.end(), side.neighbour);
        ASSERT_NE(same, others.end());
        // The polygon is nearer to the centre than the circle by 1.2e-8 of the radius, and a side may end at a sharp angle to it.
        EXPECT_NEAR(side.length, twins[i].length(static_cast<std::size_t>(same - others.begin())), 1e-5);
      }
      double of_twin = 0.0;
      for (std::size_t k = 0; k < twins[i].neighbours.size(); ++k)
        if (twins[i].neighbours[k] < 0) of_twin += twins[i].length(k);
      EXPECT_NEAR(at_rim, of_twin, 1e-5);
    }
  }
}

/// Euler: cells, sides and corners that fill a disc have N - E + V = 1, three sides meet at each corner, and of arcs there are as
/// many as corners at the rim: the sum of 6 - z over the cells, arcs counted as sides, is 6 and the number of arcs.
TEST(VoronoiCells, InACircleFillItAndHaveEulersNumberOfSides) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Eigen::Index count = 2 + static_cast<Eigen::Index>(seed * seed);
    const VoronoiCells cells(circle_of_cells, random_points_in_circle(count, seed));
    double area = 0.0, rim = 0.0;
    std::ptrdiff_t charge = 0, arcs = 0;
    for (std::size_t i = 0; i < cells.count(); ++i) {
      area += cells.area(i);
      charge += 6 - static_cast<std::ptrdiff_t>(cells.sides(i).size());
      for (const VoronoiSide& side : cells.sides(i)) {
        if (side.neighbour >= 0) continue;
        ++arcs;
        rim += side.length;
        EXPECT_TRUE(cells.at_wall(i));
      }
    }
    EXPECT_NEAR(area, circle_of_cells.area(), 1e-13 * circle_of_cells.area()) << count;
    EXPECT_NEAR(rim, 5.0 * std::numbers::pi, 1e-12) << count;
    EXPECT_EQ(charge, 6 + arcs) << count;
  }
}

/// Seven coins: the one in the middle has a hexagon, the others share the rest of the circle.
TEST(VoronoiCells, InACircleOfSevenCoinsAreKnown) {
  Eigen::Matrix2Xd positions(2, 7);
  const Eigen::Vector2d centre = 0.5 * (circle_of_cells.lower + circle_of_cells.upper);
  positions.col(0) = centre;
  for (int k = 1; k < 7; ++k)
    positions.col(k) =
        centre + Eigen::Vector2d(std::cos(k * std::numbers::pi / 3.0), std::sin(k * std::numbers::pi / 3.0)) * 5.0 / 3.0;
  const VoronoiCells cells(circle_of_cells, positions);
  const double hexagon = std::sqrt(3.0) / 2.0 * 25.0 / 9.0;
  EXPECT_NEAR(cells.area(0), hexagon, 1e-14);
  EXPECT_FALSE(cells.at_wall(0));
  EXPECT_NEAR(std::abs(psi6(cells, 0)), 1.0, 1e-14);
  for (std::size_t i = 1; i < 7; ++i) {
    EXPECT_NEAR(cells.area(i), (circle_of_cells.area() - hexagon) / 6.0, 1e-13);
    EXPECT_TRUE(cells.at_wall(i));
    EXPECT_EQ(cells.sides(i).size(), 4U) << "the hexagon, both coins beside, and the rim";
  }
}

/// A disk whose cell has two arcs stands between two others; one alone in the middle has all of the circle.
TEST(VoronoiCells, InACircleMayHaveNoneOrSeveralArcs) {
  const Eigen::Vector2d centre = 0.5 * (circle_of_cells.lower + circle_of_cells.upper);
  Eigen::Matrix2Xd positions(2, 3);
  positions << centre.x() - 1.0, centre.x(), centre.x() + 1.0, centre.y(), centre.y(), centre.y();
  const VoronoiCells three(circle_of_cells, positions);
  const double strip = 2.0 * (0.5 * std::sqrt(6.25 - 0.25) + 6.25 * std::asin(0.2));
  EXPECT_EQ(three.sides(1).size(), 4U);
  EXPECT_NEAR(three.area(1), strip, 1e-13);
  EXPECT_NEAR(three.area(0), (circle_of_cells.area() - strip) / 2.0, 1e-13);
  for (const Eigen::Vector2d& at : {centre, Eigen::Vector2d(centre + Eigen::Vector2d(0.3, -1.0))}) {
    const VoronoiCells one(circle_of_cells, at);
    EXPECT_NEAR(one.area(0), circle_of_cells.area(), 1e-14);
    EXPECT_TRUE(one.at_wall(0));
  }
}

void expect_means_over_cut_cells(const Observed& o, const std::string& observable) {
  double local = 0.0, global = 0.0, by_area = 0.0, local_unweighted = 0.0, variance = 0.0, perimeter = 0.0, whole = 0.0;
  std::vector<double> fractions(10), areas(20);
  for (const State& state : o.record.states) {
    const std::vector<CutCell> cells = cut_cells(o.scene.box, state.positions, state.shear_displacement);
    const double mean = o.scene.box.area() / static_cast<double>(cells.size());
    std::complex<double> all = 0.0, all_areas = 0.0;
    double here = 0.0, its_area = 0.0;
    for (const CutCell& cell : cells) {
      const double area = o.scene.box.is_circle ? area_with_arcs(cell, 0.5 * o.scene.box.lengths().x()) : cell.area();
      variance += std::pow(area / mean - 1.0, 2) / static_cast<double>(cells.size());
      if (const auto bin = static_cast<std::size_t>(5.0 * area / mean); bin < 20)
        areas[bin] += 1.0 / static_cast<double>(cells.size());
      if (cell.at_wall()) continue;
      here += 1.0, its_area += cell.area();
      local += std::abs(cell.psi6()), perimeter += cell.perimeter();
      all += cell.psi6(), all_areas += cell.area() * cell.psi6();
      std::complex<double> alike = 0.0;
      for (const Eigen::Vector2d& to : cell.to)
        alike += std::polar(1.0 / static_cast<double>(cell.to.size()), 6.0 * std::atan2(to.y(), to.x()));
      local_unweighted += std::abs(alike);
      fractions[std::min<std::size_t>(cell.to.size(), 12) - 3] += 1.0;
    }
    whole += here;
    global += std::abs(all) / here, by_area += std::abs(all_areas) / its_area;
  }
  const auto states = static_cast<double>(o.record.states.size());
  EXPECT_NEAR(o.value(observable, "local"), local / whole, 1e-11);
  EXPECT_NEAR(o.value(observable, "local_unweighted"), local_unweighted / whole, 1e-11);
  EXPECT_NEAR(o.value(observable, "global"), global / states, 1e-11);
  EXPECT_NEAR(o.value(observable, "global_by_area"), by_area / states, 1e-11);
  EXPECT_NEAR(o.value(observable, "perimeter"), perimeter / whole, 1e-11);
  EXPECT_NEAR(o.value(observable, "area_variance"), variance / states, o.scene.box.is_circle ? 1e-9 : 1e-11);
  for (std::size_t k = 0; k < fractions.size(); ++k)
    EXPECT_NEAR(o.column(observable, 0, "fraction")[k], fractions[k] / whole, 1e-12);
  EXPECT_NEAR(o.value(observable, "fraction_6"), fractions[3] / whole, 1e-12);
  for (std::size_t b = 0; b < areas.size(); ++b)
    EXPECT_NEAR(o.column(observable, 1, "density")[b], 5.0 * areas[b] / states, 1e-11);
}

TEST(ObservedVoronoi, IsTheMeanOverCellsOfItsStates) {
  expect_means_over_cut_cells(observe(parse_scene(small_fluid("voronoi = { every = 0.5, bins = 20 }")), 0.5), "voronoi");
  expect_means_over_cut_cells(observe(parse_scene(small_mixture("voronoi = { every = 0.5, bins = 20 }")), 0.5), "voronoi");
}

TEST(ObservedVoronoi, InACircleIsTheMeanOverCellsOfItsStates) {
  const Observed o = observe(
      parse_scene("[box]\ncircle = { centre = [1.0, 2.0], radius = 4.0 }\n[[disks]]\ncount = 30\nradius = 0.4\nmass = "
                  "1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n[run]\n"
                  "time = 3.0\n[observe]\nvoronoi = { every = 0.5, bins = 20 }\n"),
      0.5);
  expect_means_over_cut_cells(o, "voronoi");
}

const std::string sheared_fluid =
    small_fluid("voronoi = { every = 0.5, bins = 20 }") + "[shear]\nrate = 0.7\n[thermostat]\ntemperature = 1.0\nrate = 1.0\n";

/// Images above are displaced as they are at the time of each state.
TEST(ObservedVoronoi, InAShearedBoxIsTheMeanOverCellsOfItsStates) {
  expect_means_over_cut_cells(observe(parse_scene(sheared_fluid), 0.5), "voronoi");
}

/// However far the images have moved, cells fill the box and have six sides on average.
TEST(ObservedVoronoi, OfEveryStateOfAShearedFluidFillsTheBox) {
  const Observed o = observe(parse_scene(sheared_fluid), 0.05);
  double farthest = 0.0;
  for (const State& state : o.record.states) {
    const VoronoiCells cells(o.scene.box, state.positions, state.shear_displacement);
    double area = 0.0, charge = 0.0;
    for (std::size_t i = 0; i < cells.count(); ++i) {
      area += cells.area(i);
      charge += 6.0 - static_cast<double>(cells.sides(i).size());
    }
    EXPECT_NEAR(area, o.scene.box.area(), 1e-12 * o.scene.box.area()) << state.time;
    EXPECT_EQ(charge, 0.0) << state.time;
    farthest = std::max(farthest, state.shear_displacement);
  }
  EXPECT_GT(o.record.states.size(), 100U);
  EXPECT_GT(farthest, 0.9 * o.scene.box.lengths().x());
}

/// A flow of rate 0 changes no bit of what is measured.
TEST(ObservedVoronoi, AtRateZeroIsThatOfTheBoxAtRest) {
  const std::string at_rest = small_fluid("voronoi = { every = 0.5 }");
  const Observed o = observe(parse_scene(at_rest), 0.5), neutral = observe(parse_scene(at_rest + "[shear]\nrate = 0.0\n"), 0.5);
  for (std::size_t k = 0; k < o.of("voronoi").scalars.size(); ++k)
    EXPECT_EQ(o.of("voronoi").scalars[k].value, neutral.of("voronoi").scalars[k].value);
}

/// The states of disks on a torus have as many cells too many as too few.
TEST(ObservedVoronoi, FractionsOfATorusHaveSixNeighboursOnAverage) {
  const Observed o = observe(parse_scene(small_fluid("voronoi = { every = 0.1 }")), 0.5);
  double mean = 0.0;
  for (std::size_t k = 0; k < 10; ++k) mean += o.column("voronoi", 0, "neighbours")[k] * o.column("voronoi", 0, "fraction")[k];
  EXPECT_NEAR(mean, 6.0, 1e-13);
}

/// Growing disks are packed ever more densely; their cells are those of their centres all the time.
TEST(ObservedVoronoi, FollowsDisksThatGrow) {
  const Observed o = observe(
      parse_scene(
          "[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = 60\nradius = 0.5\nmass = 1.0\npacking_fraction = "
          "0.3\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n[growth]\nrate = "
          "0.1\nuntil = { packing_fraction = 0.5 }\n[run]\ntime = 2.0\n[observe]\nvoronoi = { every = 0.25, bins = 20 }\n"),
      0.25);
  expect_means_over_cut_cells(o, "voronoi");
}

}  // namespace
}  // namespace carom::test
