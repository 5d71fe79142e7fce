#pragma once
// Scenes put together by hand, and what tests ask of states.

#include "core/nearest_image.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {

inline Box box_of(double x, double y, Boundary in_x, Boundary in_y) { return {{0.0, 0.0}, {x, y}, {in_x, in_y}}; }
inline Box box_of(double x, double y, Boundary boundary) { return box_of(x, y, boundary, boundary); }

inline Species species_of(std::int64_t count, double radius, double mass, Positions positions, Velocities velocities) {
  Species species;
  species.count = count;
  species.radius = radius;
  species.mass = mass;
  species.positions = std::move(positions);
  species.velocities = std::move(velocities);
  return species;
}

inline Scene scene_of(const Box& box, std::vector<Species> species, std::uint64_t seed = 1) {
  Scene scene;
  scene.box = box;
  scene.species = std::move(species);
  scene.run.seed = seed;
  return scene;
}

/// The same bits, not merely equal numbers: tells 0 from -0 too.
inline bool same_bits(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b) {
  return a.cols() == b.cols() && std::equal(a.data(), a.data() + a.size(), b.data(),
                                            [](double x, double y) { return x == y && std::signbit(x) == std::signbit(y); });
}

inline bool same_bits(const State& a, const State& b) {
  return a.time == b.time && same_bits(a.positions, b.positions) && same_bits(a.velocities, b.velocities) && a.images == b.images;
}

/// The smallest distance of two disks, of a disk and an image, or of a disk and its own image.
inline double smallest_distance(const Box& box, const Eigen::Matrix2Xd& positions) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 2; ++a) {
    if (box.periodic(a) && positions.cols() > 0) smallest = std::min(smallest, box.lengths()[a]);
  }
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      smallest = std::min(smallest, nearest_image(box, positions.col(i) - positions.col(j)).norm());
    }
  }
  return smallest;
}

}  // namespace carom::test
