#pragma once
// The slow twin of Obstacles: asks every obstacle, and every image of it up to some box lengths away.

#include "effects/obstacles.hpp"

namespace carom::test {

class AllObstacles {
 public:
  AllObstacles(const Box& box, const std::vector<Obstacle>& obstacles)
      : domain_(box), shapes_(domain_, RectangleBins(box, bounds_of(obstacles)), obstacles) {}

  [[nodiscard]] ObstacleMeeting<double> next(const DiskPath<double>& path, double until, std::int64_t images) const {
    const std::int64_t columns = domain_.periodic[0] ? images : 0;
    const std::int64_t rows = domain_.periodic[1] ? images : 0;
    ObstacleMeeting<double> first;
    for (std::int32_t o = 0; o < shapes_.count(); ++o)
      for (std::int64_t row = -rows; row <= rows; ++row)
        for (std::int64_t column = -columns; column <= columns; ++column) shapes_.meet(first, path, o, {column, row}, until);
    return first;
  }

 private:
  SimulationBox<double> domain_;
  ObstacleShapes<double> shapes_;
};

}  // namespace carom::test
