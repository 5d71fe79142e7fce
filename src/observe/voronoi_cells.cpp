// The topology of the cells is found by Boost.Polygon, whose predicates are exact for integers: centres are rounded to a grid of
// some 2^-30 of the box, on which a shift by a box length, or by that of sheared images, and a reflection at a wall are exact
// too. Lengths and areas are computed from the centres themselves.
//
// Boost knows no periodic boxes. Images within a reach of the box are added. A corner of a cell is right if the circle around it
// through the centre lies within that reach; where one does not, the reach is doubled.
//
// In flat boxes with wide gaps most of these images are of no use. A cell lies within that of its disk's own images, which are a
// lattice: of no corner is it farther from the disk than half a box length along either axis. The same holds for the other cells
// at that corner, so that neighbours are at most a box length away along either axis. Behind walls they are in the next box. In a
// sheared box the two shortest steps of the lattice take the place of the axes.
//
// In a circle there are no images: cells without an end are cut off. The bisector to a neighbour is a chord of the circle, of
// which the bisectors to the other neighbours leave a side or nothing. Where a side ends at the rim, an arc follows until the
// next side begins there.

#include "observe/voronoi_cells.hpp"

#include "core/vec2.hpp"

#include <boost/polygon/voronoi.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

namespace carom {

namespace {

using GridPoint = boost::polygon::point_data<std::int32_t>;

/// Where cells are sought: a box, whose images above are displaced along x where it is sheared.
struct CellSpace {
  Box box;
  double displacement = 0.0;
};

/// An image of a disk: in the box that is so many boxes to the right and above; of walls, every second one is reflected.
struct Image {
  std::int32_t disk = 0;
  std::array<std::int32_t, 2> shift = {};
  friend bool operator==(const Image&, const Image&) = default;
};

/// The neighbours of each disk, in no order.
using Neighbours = std::vector<std::vector<Image>>;

/// Returns the number of boxes to a side whose images are within a reach.
double boxes_within(const Box& box, double reach) {
  return ((box.lengths().array() + 2.0 * reach) / box.lengths().array()).prod();
}

class Grid {
 public:
  /// Adds all images within a reach or, without one, all that can be neighbours. Requires a box whose walls enclose all centres.
  Grid(const CellSpace& space, const Eigen::Matrix2Xd& positions, std::optional<double> reach)
      : box_(space.box), is_complete_(!reach) {
    constexpr double largest = 2.0e9;  // of an int32
    const Box& box = space.box;
    const double longest = box.lengths().maxCoeff(), farthest = space.displacement == 0.0 ? longest : 7.0 * longest;
    const double unit = largest / (longest + reach.value_or(farthest));
    for (int axis = 0; axis < 2; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      length_[a] = std::max<std::int64_t>(4, std::llround(unit * box.lengths()[axis]));
      reach_[a] = reach ? std::floor(unit * *reach) : static_cast<double>(length_[a]);
    }
    displacement_ = std::llround(unit * space.displacement);
    for (Eigen::Index i = 0; i < positions.cols(); ++i) add(i, positions.col(i));
    if (is_complete_ && displacement_ != 0) {
      add_images_along_shortest_steps();
      return;
    }
    const std::size_t count = images_.size();
    std::array<std::int32_t, 2> boxes;
    for (std::size_t axis = 0; axis < 2; ++axis)
      boxes[axis] = static_cast<std::int32_t>(std::ceil(reach_[axis] / static_cast<double>(length_[axis])));
    const auto aside = static_cast<std::int32_t>(std::abs(displacement_ * boxes[1]) / length_[0]) + (displacement_ != 0 ? 1 : 0);
    for (std::int32_t x = -boxes[0] - aside; x <= boxes[0] + aside; ++x)
      for (std::int32_t y = -boxes[1]; y <= boxes[1]; ++y)
        if (x != 0 || y != 0)
          for (std::size_t i = 0; i < count; ++i) add_image(i, {x, y});
  }

  /// Returns the neighbours of all disks, with -1 for walls; nothing where the images do not reach far enough.
  [[nodiscard]] std::optional<Neighbours> neighbours() const {
    boost::polygon::voronoi_diagram<double> diagram;
    boost::polygon::construct_voronoi(points_.begin(), points_.end(), &diagram);
    Neighbours found(count_);
    std::size_t cells = 0;
    for (const auto& cell : diagram.cells()) {
      const std::size_t i = cell.source_index();
      if (i >= count_) continue;
      ++cells;
      const auto* const first = cell.incident_edge();
      if (first == nullptr) return std::nullopt;
      const auto* edge = first;
      do {
        if (!edge->is_finite() || !(is_complete_ || is_covered(points_[i], *edge->vertex0()))) return std::nullopt;
        Image image = images_[edge->twin()->cell()->source_index()];
        for (std::size_t axis = 0; axis < 2; ++axis) image.shift[axis] -= images_[i].shift[axis];
        keep(i, image, found[i]);
        edge = edge->next();
      } while (edge != first);
    }
    if (cells < count_) throw std::invalid_argument("two disks have the same centre, which has no Voronoi cell");
    return found;
  }

 private:
  /// A step from an image to another, which is so many boxes to the right and above.
  struct Step {
    std::array<std::int64_t, 2> by;
    std::array<std::int32_t, 2> boxes;
    [[nodiscard]] std::int64_t dot(const std::array<std::int64_t, 2>& other) const { return by[0] * other[0] + by[1] * other[1]; }
    /// Adds a number of other steps.
    void add(std::int64_t number, const Step& other) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        by[axis] += number * other.by[axis];
        boxes[axis] += static_cast<std::int32_t>(number) * other.boxes[axis];
      }
    }
  };

  /// Returns the two shortest steps, the shortest first (Gauss's reduction).
  [[nodiscard]] std::array<Step, 2> shortest_steps() const {
    Step a{{length_[0], 0}, {1, 0}}, b{{displacement_, length_[1]}, {0, 1}};
    for (;;) {
      b.add(-std::llround(static_cast<double>(a.dot(b.by)) / static_cast<double>(a.dot(a.by))), a);
      if (b.dot(b.by) >= a.dot(a.by)) return {a, b};
      std::swap(a, b);
    }
  }

  /// Moves the disks into the parallelogram of the two shortest steps, and adds what is at most one of these steps away along
  /// each.
  void add_images_along_shortest_steps() {
    const std::array<Step, 2> steps = shortest_steps();
    const auto area = static_cast<double>(length_[0] * length_[1]);
    const auto sign = steps[0].by[0] * steps[1].by[1] > steps[0].by[1] * steps[1].by[0] ? 1.0 : -1.0;
    std::vector<Step> disks;
    std::array<std::int64_t, 2> least{}, most{};  // along each of the steps
    for (std::size_t i = 0; i < count_; ++i) {
      Step disk{{points_[i].x(), points_[i].y()}, {}};
      const auto share = [&](std::size_t of) {
        const std::array<std::int64_t, 2>& other = steps[1 - of].by;
        const auto cross = static_cast<double>(disk.by[0] * other[1] - disk.by[1] * other[0]);
        return std::llround(std::floor((of == 0 ? sign : -sign) * cross / area));
      };
      const std::array<std::int64_t, 2> whole = {share(0), share(1)};
      for (std::size_t k = 0; k < 2; ++k) disk.add(-whole[k], steps[k]);
      for (std::size_t k = 0; k < 2; ++k) {
        const std::int64_t along = steps[k].dot(disk.by), square = steps[k].dot(steps[k].by);
        least[k] = i == 0 ? along - square : std::min(least[k], along - square);
        most[k] = i == 0 ? along + square : std::max(most[k], along + square);
      }
      disks.push_back(disk);
    }
    images_.clear(), points_.clear();
    const auto put = [&](std::size_t i, const Step& image) {
      images_.push_back({static_cast<std::int32_t>(i), image.boxes});
      points_.emplace_back(static_cast<std::int32_t>(image.by[0]), static_cast<std::int32_t>(image.by[1]));
    };
    for (std::size_t i = 0; i < count_; ++i) put(i, disks[i]);
    for (std::int64_t m = -2; m <= 2; ++m)
      for (std::int64_t n = -2; n <= 2; ++n)
        for (std::size_t i = 0; i < count_ && (m != 0 || n != 0); ++i) {
          Step image = disks[i];
          image.add(m, steps[0]), image.add(n, steps[1]);
          const std::array<std::int64_t, 2> along = {steps[0].dot(image.by), steps[1].dot(image.by)};
          if (along[0] >= least[0] && along[0] <= most[0] && along[1] >= least[1] && along[1] <= most[1]) put(i, image);
        }
  }

  /// Requires a centre in the box.
  void add(Eigen::Index i, const Eigen::Vector2d& centre) {
    std::array<std::int64_t, 2> at{};
    for (int axis = 0; axis < 2; ++axis) {
      const std::int64_t length = length_[static_cast<std::size_t>(axis)];
      const double share = (centre[axis] - box_.lower[axis]) / box_.lengths()[axis];
      // The image of a centre that is on a wall to rounding must not be at the same place.
      const std::int64_t least = box_.periodic(axis) ? 0 : 1;
      at[static_cast<std::size_t>(axis)] =
          std::clamp(static_cast<std::int64_t>(share * static_cast<double>(length)), least, length - 1);
    }
    images_.push_back({static_cast<std::int32_t>(i), {}});
    points_.emplace_back(static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]));
    count_ = images_.size();
  }

  void add_image(std::size_t i, const std::array<std::int32_t, 2>& shift) {
    std::array<std::int64_t, 2> at = {points_[i].x(), points_[i].y()};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const bool reflected = !box_.periodic(static_cast<int>(axis)) && shift[axis] % 2 != 0;
      at[axis] = shift[axis] * length_[axis] + (reflected ? length_[axis] - at[axis] : at[axis]);
      if (axis == 0) at[axis] += shift[1] * displacement_;
      const auto place = static_cast<double>(at[axis]);
      if (place < -reach_[axis] || place > static_cast<double>(length_[axis]) + reach_[axis]) return;
    }
    images_.push_back({static_cast<std::int32_t>(i), shift});
    points_.emplace_back(static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]));
  }

  /// Returns whether all centres in the circle around a corner through a centre are among the points.
  template <class Vertex>
  [[nodiscard]] bool is_covered(const GridPoint& centre, const Vertex& corner) const {
    const std::array<double, 2> at = {corner.x(), corner.y()};
    const double radius = std::hypot(at[0] - centre.x(), at[1] - centre.y());
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (at[axis] - radius < -reach_[axis] || at[axis] + radius > static_cast<double>(length_[axis]) + reach_[axis])
        return false;
    return true;
  }

  /// Keeps a neighbour. Behind a wall there is the image of the disk itself; those of others touch the cell in a point at most.
  void keep(std::size_t i, const Image& image, std::vector<Image>& found) const {
    int walls = 0;
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (!box_.periodic(static_cast<int>(axis)) && image.shift[axis] != 0) ++walls;
    if (walls == 0) {
      found.push_back(image);
      return;
    }
    const bool beside = (image.shift[0] == 0) != (image.shift[1] == 0);
    if (beside && image.disk == static_cast<std::int32_t>(i)) found.push_back({-1, image.shift});
  }

  Box box_;
  std::array<std::int64_t, 2> length_{};  ///< of the box
  std::int64_t displacement_ = 0;         ///< of the images above
  std::array<double, 2> reach_{};
  bool is_complete_;           ///< whether every image that can be a neighbour is among the points
  std::size_t count_ = 0;      ///< of disks
  std::vector<Image> images_;  ///< the disks themselves come first
  std::vector<GridPoint> points_;
};

/// Returns the image of the disk `from` as its neighbour `to` has it. Requires that it is not a wall.
Image seen_back(std::size_t from, const Image& to) { return {static_cast<std::int32_t>(from), {-to.shift[0], -to.shift[1]}}; }

Eigen::Vector2d way_to(const CellSpace& space, const Eigen::Matrix2Xd& positions, std::size_t i, const Image& image) {
  const Box& box = space.box;
  const auto self = static_cast<Eigen::Index>(i);
  Eigen::Vector2d to =
      image.disk < 0 ? Eigen::Vector2d(0.0, 0.0) : Eigen::Vector2d(positions.col(image.disk) - positions.col(self));
  for (int axis = 0; axis < 2; ++axis) {
    const std::int32_t shift = image.shift[static_cast<std::size_t>(axis)];
    if (shift == 0) continue;
    if (image.disk < 0)
      to[axis] = 2.0 * ((shift < 0 ? box.lower[axis] : box.upper[axis]) - positions(axis, self));
    else
      to[axis] += shift * box.lengths()[axis];
  }
  if (image.disk >= 0 && image.shift[1] != 0) to.x() += image.shift[1] * space.displacement;
  return to;
}

/// A neighbour, and the way there.
struct Direction {
  Image image;
  Eigen::Vector2d to;
};
using Directions = std::vector<std::vector<Direction>>;

void sort_by_angle(std::vector<Direction>& around) {
  std::sort(around.begin(), around.end(), [](const Direction& a, const Direction& b) {
    return std::atan2(a.to.y(), a.to.x()) < std::atan2(b.to.y(), b.to.x());
  });
}

/// Two of three centres of a corner may be told that they are neighbours where the third cell lost a side of no length.
void make_mutual(Neighbours& neighbours) {
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    for (std::size_t k = 0; k < neighbours[i].size(); ++k) {
      const Image to = neighbours[i][k];
      if (to.disk < 0) continue;
      std::vector<Image>& theirs = neighbours[static_cast<std::size_t>(to.disk)];
      const Image back = seen_back(i, to);
      if (std::find(theirs.begin(), theirs.end(), back) == theirs.end()) theirs.push_back(back);
    }
}

/// Divides polygons of four and more centres, which are on one circle, into triangles. Requires that there are no walls.
void triangulate(const CellSpace& space, const Eigen::Matrix2Xd& positions, Directions& around) {
  std::vector<std::vector<bool>> visited(around.size());
  for (std::size_t i = 0; i < around.size(); ++i) visited[i].resize(around[i].size());
  std::vector<std::array<Image, 2>> diagonals;  // from one to the other
  for (std::size_t i = 0; i < around.size(); ++i) {
    for (std::size_t k = 0; k < around[i].size(); ++k) {
      if (visited[i][k]) continue;
      std::vector<Image> corners;
      Image at{static_cast<std::int32_t>(i), {}};
      for (std::size_t here = k; !visited[static_cast<std::size_t>(at.disk)][here];) {
        const auto from = static_cast<std::size_t>(at.disk);
        visited[from][here] = true;
        corners.push_back(at);
        const Image to = around[from][here].image;
        at = {to.disk, {at.shift[0] + to.shift[0], at.shift[1] + to.shift[1]}};
        const std::vector<Direction>& theirs = around[static_cast<std::size_t>(to.disk)];
        const auto back =
            std::find_if(theirs.begin(), theirs.end(), [&](const Direction& one) { return one.image == seen_back(from, to); });
        if (back == theirs.end()) throw std::logic_error("a Voronoi cell has a neighbour that does not have it");
        here = (static_cast<std::size_t>(back - theirs.begin()) + theirs.size() - 1) % theirs.size();
      }
      for (std::size_t c = 2; c + 1 < corners.size(); ++c) diagonals.push_back({corners[0], corners[c]});
    }
  }
  const auto join = [&](const Image& from, const Image& to) {
    const Image image{to.disk, {to.shift[0] - from.shift[0], to.shift[1] - from.shift[1]}};
    const auto i = static_cast<std::size_t>(from.disk);
    around[i].push_back({image, way_to(space, positions, i, image)});
  };
  for (const auto& [a, b] : diagonals) join(a, b), join(b, a);
  for (std::vector<Direction>& one : around) sort_by_angle(one);
}

/// The centre of the circle through 0, a and b.
Eigen::Vector2d circumcentre(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double twice = 2.0 * (a.x() * b.y() - a.y() * b.x()), aa = a.squaredNorm(), bb = b.squaredNorm();
  return {(b.y() * aa - a.y() * bb) / twice, (a.x() * bb - b.x() * aa) / twice};
}

/// Returns the neighbours of each disk where there are no images, in no order.
std::vector<std::vector<std::int32_t>> neighbours_in_plane(const Box& box, const Eigen::Matrix2Xd& positions) {
  std::vector<GridPoint> points;
  const double unit = 2.0e9 / box.lengths().maxCoeff();
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    const Eigen::Vector2d at = unit * (positions.col(i) - box.lower);
    points.emplace_back(static_cast<std::int32_t>(at.x()), static_cast<std::int32_t>(at.y()));
  }
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);
  if (diagram.num_cells() < points.size())
    throw std::invalid_argument("two disks have the same centre, which has no Voronoi cell");
  std::vector<std::vector<std::int32_t>> found(points.size());
  for (const auto& cell : diagram.cells()) {
    const auto* const first = cell.incident_edge();
    if (first == nullptr) continue;  // a disk alone
    const auto* edge = first;
    do {
      found[cell.source_index()].push_back(static_cast<std::int32_t>(edge->twin()->cell()->source_index()));
      edge = edge->next();
    } while (edge != first);
  }
  return found;
}

/// A cell in a circle, as its disk at the origin sees it.
class CellInCircle {
 public:
  /// Requires the neighbours in the order of their directions.
  CellInCircle(const Eigen::Vector2d& centre, double radius, const std::vector<Direction>& neighbours)
      : centre_(centre), radius_(radius) {
    for (std::size_t k = 0; k < neighbours.size(); ++k)
      if (const std::optional<Side> side = side_to(neighbours, k)) sides_.push_back(*side);
  }

  /// Appends the sides and arcs, and returns the area.
  double finish(std::vector<VoronoiSide>& found, bool& at_wall) const {
    at_wall = sides_.empty();
    if (at_wall) {
      const double square = centre_.squaredNorm();  // the arc is all of the rim; its middle is where the disk is nearest to it
      const Eigen::Vector2d outward = square > 0.0 ? Eigen::Vector2d(-centre_.normalized()) : Eigen::Vector2d(1.0, 0.0);
      found.push_back({-1, 2.0 * (centre_ + radius_ * outward), 2.0 * std::numbers::pi * radius_});
      return std::numbers::pi * radius_ * radius_;
    }
    double area = 0.0;
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      const Side &side = sides_[k], &next = sides_[(k + 1) % sides_.size()];
      area += 0.5 * cross<double>(side.begin, side.end);
      found.push_back({side.neighbour, side.to, (side.end - side.begin).norm()});
      if (!side.ends_at_rim || !next.begins_at_rim) continue;
      const Eigen::Vector2d from = side.end - centre_, to = next.begin - centre_;
      double angle = std::atan2(cross<double>(from, to), from.dot(to));
      if (angle < -1e-9) angle += 2.0 * std::numbers::pi;  // an arc of a corner at the rim is empty to rounding
      area += 0.5 * cross<double>(side.end, next.begin) + 0.5 * radius_ * radius_ * (angle - std::sin(angle));
      const Eigen::Rotation2Dd half(0.5 * angle);
      found.push_back({-1, 2.0 * (centre_ + half * from), std::max(0.0, radius_ * angle)});
      at_wall = true;
    }
    return area;
  }

 private:
  /// A side, which runs counter-clockwise.
  struct Side {
    std::int32_t neighbour;
    Eigen::Vector2d to, begin, end;
    bool begins_at_rim, ends_at_rim;
  };

  /// Returns the side to a neighbour; nothing where none of it is in the circle.
  [[nodiscard]] std::optional<Side> side_to(const std::vector<Direction>& neighbours, std::size_t k) const {
    const Eigen::Vector2d& to = neighbours[k].to;
    const Eigen::Vector2d across = to.normalized(), along(-across.y(), across.x()), middle = 0.5 * to;
    const double distance = (middle - centre_).dot(across), square = radius_ * radius_ - distance * distance;
    if (!(square > 0.0)) return {};
    const double half = std::sqrt(square), foot = (centre_ - middle).dot(along);
    double begin = foot - half, end = foot + half;
    bool begins_at_rim = true, ends_at_rim = true;
    for (std::size_t other = 0; other < neighbours.size(); ++other) {
      if (other == k) continue;
      const Eigen::Vector2d& there = neighbours[other].to;
      const double slope = along.dot(there), beyond = middle.dot(there) - 0.5 * there.squaredNorm();
      const double crossing = -beyond / slope;
      if (slope > 0.0 && crossing < end) end = crossing, ends_at_rim = false;
      if (slope < 0.0 && crossing > begin) begin = crossing, begins_at_rim = false;
      if (slope == 0.0 && beyond > 0.0) return {};
    }
    if (!(begin < end)) return {};
    return Side{neighbours[k].image.disk, to, middle + begin * along, middle + end * along, begins_at_rim, ends_at_rim};
  }

  Eigen::Vector2d centre_;  ///< of the circle
  double radius_;
  std::vector<Side> sides_;
};

Neighbours neighbours_of(const CellSpace& space, const Eigen::Matrix2Xd& positions) {
  const auto count = static_cast<double>(positions.cols());
  const double spacing = std::sqrt(space.box.area() / count);
  constexpr double few = 2'000.0, boxes_that_matter = 9.0;
  for (double reach = 4.0 * spacing; count * boxes_within(space.box, reach) <= std::max(few, boxes_that_matter * count);
       reach *= 2.0)
    if (std::optional<Neighbours> found = Grid(space, positions, reach).neighbours()) return std::move(*found);
  std::optional<Neighbours> found = Grid(space, positions, std::nullopt).neighbours();
  if (!found) throw std::logic_error("a Voronoi cell has no end");
  return std::move(*found);
}

}  // namespace

std::complex<double> sixfold_order(std::span<const VoronoiSide> sides) {
  std::complex<double> sum = 0.0;
  double perimeter = 0.0;
  for (const VoronoiSide& side : sides) {
    const std::complex<double> u = std::complex<double>(side.to.x(), side.to.y()) / side.to.norm(), cube = u * u * u;
    sum += side.length * cube * cube;
    perimeter += side.length;
  }
  return sum / perimeter;
}

void VoronoiCells::cut_by_circle(const Box& box, const Eigen::Matrix2Xd& positions) {
  const std::vector<std::vector<std::int32_t>> neighbours = neighbours_in_plane(box, positions);
  const Eigen::Vector2d centre = 0.5 * (box.lower + box.upper);
  const double radius = 0.5 * box.lengths().x();
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const Eigen::Vector2d self = positions.col(static_cast<Eigen::Index>(i));
    std::vector<Direction> around;
    for (const std::int32_t j : neighbours[i]) around.push_back({{j, {}}, positions.col(j) - self});
    sort_by_angle(around);
    bool at_wall = false;
    areas_.push_back(CellInCircle(centre - self, radius, around).finish(sides_, at_wall));
    first_.push_back(sides_.size());
    at_wall_.push_back(at_wall);
  }
}

VoronoiCells::VoronoiCells(const Box& box, const Eigen::Matrix2Xd& positions, double shear_displacement) : first_{0} {
  const auto count = static_cast<std::size_t>(positions.cols());
  if (count == 0) return;
  if (box.is_circle) {
    cut_by_circle(box, positions);
    return;
  }
  const CellSpace space{box, shear_displacement};
  Neighbours neighbours = neighbours_of(space, positions);
  make_mutual(neighbours);
  Directions around(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const Image& image : neighbours[i]) around[i].push_back({image, way_to(space, positions, i, image)});
    sort_by_angle(around[i]);
  }
  const bool is_torus = box.periodic(0) && box.periodic(1);
  if (is_torus) triangulate(space, positions, around);
  std::vector<Eigen::Vector2d> corners;
  for (const std::vector<Direction>& all : around) {
    corners.clear();
    for (std::size_t k = 0; k < all.size(); ++k) corners.push_back(circumcentre(all[k].to, all[(k + 1) % all.size()].to));
    double area = 0.0;
    bool at_wall = false;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Eigen::Vector2d& to = all[k].to;
      const Eigen::Vector2d side = corners[k] - corners[(k + all.size() - 1) % all.size()];
      const double distance = to.norm(), length = (to.x() * side.y() - to.y() * side.x()) / distance;
      area += 0.25 * distance * length;
      at_wall = at_wall || all[k].image.disk < 0;
      sides_.push_back({all[k].image.disk, to, std::max(0.0, length)});
    }
    first_.push_back(sides_.size());
    areas_.push_back(area);
    at_wall_.push_back(at_wall);
  }
  // Euler's formula for a torus: without it the neighbours are not those of a triangulation.
  if (is_torus && sides_.size() != 6 * count) throw std::logic_error("Voronoi cells on a torus do not have six sides on average");
}

}  // namespace carom
