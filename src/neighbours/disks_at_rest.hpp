#pragma once
// Searches for the disks near a given place, of disks that do not move: for placing a start and for looking for overlaps in a
// state. Independent of the engines' cell grid, so that it can check them.
//
// Disks are kept in layers by size, radii within a factor of two in one layer, each layer with cells as wide as its
// own disks. So one large disk among a million small ones costs nothing.

#include "core/contact_scales.hpp"

#include <carom/box.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace carom {

class DisksAtRest {
 public:
  /// The disks to come: radius[i] belongs to disk i, and so does its species in `scales`. None is in place yet. Requires `radius`
  /// and `scales` to live as long as this.
  DisksAtRest(const Box& box, const std::vector<double>& radius, const ContactScales<double>& scales);
  DisksAtRest(const Box& box, const std::vector<double>& radius, ContactScales<double>&&) = delete;

  /// Puts disk i at a position inside the box, given as a sum with a small remainder.
  void insert(std::int32_t i, const Eigen::Vector2d& position, const Eigen::Vector2d& remainder = Eigen::Vector2d::Zero());

  struct Neighbour {
    std::int32_t disk;
    double relative_overlap;  ///< (sigma - distance) / sigma with sigma the contact distance; > 0 where they overlap
  };

  /// Returns the disk in place, other than itself, that disk i would overlap most at `position`, all periodic images counted;
  /// {-1, 0} where it overlaps none. With `larger_only` disks in layers of smaller radii are left out: over all disks every pair
  /// is then still seen, from its smaller partner.
  [[nodiscard]] Neighbour deepest(const Eigen::Vector2d& position, std::int32_t i, bool larger_only = false,
                                  const Eigen::Vector2d& remainder = Eigen::Vector2d::Zero()) const;
  /// Returns whether disk i would overlap any disk in place at `position`; all were put there without remainders. Faster than
  /// deepest(), which looks at all near it.
  [[nodiscard]] bool overlaps(const Eigen::Vector2d& position, std::int32_t i) const;

 private:
  struct Layer {
    int exponent = 0;  ///< radii in [2^exponent, 2^(exponent+1))
    std::size_t disks = 0;
    Eigen::Vector2d width = Eigen::Vector2d::Zero();
    std::int64_t cells[2] = {1, 1};
    std::vector<std::int32_t> first;
  };

  [[nodiscard]] std::int64_t cell_of(const Layer& layer, int axis, double x) const;
  /// The cells along an axis with all disks of a layer that disk i may overlap at x; on periodic axes it goes on beyond the
  /// edges.
  struct Range {
    std::int64_t from, to;
  };
  [[nodiscard]] Range cells_near(const Layer& layer, int axis, double x, double radius) const;
  /// Calls f(j, apart) for each disk j in a cell, `apart` from `position`, until it returns true; whether it did.
  template <class F>
  bool any_in(const Layer& layer, std::int64_t x, std::int64_t y, const Eigen::Vector2d& position, F&& f) const;

  Box box_;
  const std::vector<double>& radius_;
  const ContactScales<double>& scales_;
  double farthest_;            ///< the largest of them
  std::vector<Layer> layers_;  ///< by falling size
  std::vector<std::int32_t> next_;
  std::vector<Eigen::Vector2d> position_;
  std::vector<Eigen::Vector2d> remainder_;  ///< empty while all are zero
};

/// The deepest overlap in a state.
struct DeepestOverlap {
  double relative = 0.0;  ///< (sigma_ij - |r_ij|) / sigma_ij, 0 where no pair overlaps
  std::int32_t first = -1;
  std::int32_t second = -1;
};

/// Over all pairs of disks and their images on periodic axes. O(N). Requires positions inside the box; `remainders` has as
/// many columns, or none. The distance of a pair is taken to 2^-52 of itself, not of the box.
[[nodiscard]] DeepestOverlap deepest_overlap(const Box& box, const std::vector<double>& radius, const Eigen::Matrix2Xd& positions,
                                             const Eigen::Matrix2Xd& remainders = Eigen::Matrix2Xd(2, 0),
                                             const ContactScales<double>& scales = {});

/// The first disk that overlaps one before it by more than `tolerance` of their contact distance, with the one that it
/// overlaps most as `first`; relative 0 where there is none. Fast however many disks lie in one place.
[[nodiscard]] DeepestOverlap first_overlap(const Box& box, const std::vector<double>& radius,
                                           const std::vector<Eigen::Vector2d>& positions, double tolerance,
                                           const ContactScales<double>& scales = {});

}  // namespace carom
