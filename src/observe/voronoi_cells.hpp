#pragma once
// The Voronoi cells of the disks' centres, in periodic boxes, between walls and in circular boxes.

#include <carom/box.hpp>

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// A side of a Voronoi cell.
struct VoronoiSide {
  std::int32_t neighbour = -1;  ///< id of the disk on the other side, which may be the disk itself; -1 at a wall
  Eigen::Vector2d to = {};  ///< from the centre to that of the neighbour; at a wall to its mirror image, at the rim of a circle
                            ///< twice as far as the middle of the arc
  double length = 0.0;      ///< length of the side, which may be an arc, >= 0
};

/// The Voronoi cells of the centres, whatever the radii. Walls cut the cells off, and so does the rim of a circle, along arcs:
/// the areas of all cells add up to that of the box.
///
/// In a periodic box the neighbours are those of a triangulation, so that the sum of 6 - z over the disks, z the number of
/// neighbours, is 0. Where four or more centres are on an empty circle, as in a square lattice, one choice of diagonals is made,
/// whose sides have the length 0.
class VoronoiCells {
 public:
  /// Images above a sheared box are displaced along x by `shear_displacement`, n boxes above by n times that. Requires that no
  /// two centres coincide; throws std::invalid_argument where they do.
  VoronoiCells(const Box& box, const Eigen::Matrix2Xd& positions, double shear_displacement = 0.0);

  /// Returns the number of cells.
  [[nodiscard]] std::size_t count() const { return areas_.size(); }
  /// Returns the sides of a cell, counter-clockwise.
  [[nodiscard]] std::span<const VoronoiSide> sides(std::size_t cell) const {
    return std::span(sides_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
  }
  [[nodiscard]] double area(std::size_t cell) const { return areas_[cell]; }
  /// Returns whether a side of the cell is a wall.
  [[nodiscard]] bool at_wall(std::size_t cell) const { return at_wall_[cell]; }

 private:
  void cut_by_circle(const Box& box, const Eigen::Matrix2Xd& positions);

  std::vector<std::size_t> first_;  ///< side of each cell
  std::vector<VoronoiSide> sides_;
  std::vector<double> areas_;
  std::vector<bool> at_wall_;
};

/// Returns the sixfold order psi of a cell: the mean of exp(6 i theta) over its sides, weighted by their lengths, theta the
/// direction to the neighbour (Mickel et al., J. Chem. Phys. 138, 044501 (2013)).
[[nodiscard]] std::complex<double> sixfold_order(std::span<const VoronoiSide> sides);

}  // namespace carom
