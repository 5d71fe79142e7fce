#include "studies/state_distance.hpp"

#include "core/nearest_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

Eigen::Vector2d displacement(const Box& box, const State& a, const State& b, Eigen::Index i) {
  // The doubles of two disks that are close differ by no rounding; the remainders are added to that.
  Eigen::Vector2d apart = a.positions.col(i) - b.positions.col(i);
  if (a.shear_displacement != 0.0) apart.x() -= a.shear_displacement * std::round(apart.y() / box.lengths().y());
  apart = nearest_image(box, apart);
  if (a.remainders.cols() > i) apart += a.remainders.col(i);
  if (b.remainders.cols() > i) apart -= b.remainders.col(i);
  return apart;
}

double largest_distance(const Box& box, const State& a, const State& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.positions.cols(); ++i) {
    const double distance = displacement(box, a, b, i).norm();
    if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, distance);
  }
  return largest;
}

double rms_distance(const Box& box, const State& a, const State& b) {
  Eigen::Matrix2Xd apart(2, a.positions.cols());
  for (Eigen::Index i = 0; i < apart.cols(); ++i) apart.col(i) = displacement(box, a, b, i);
  if (!apart.allFinite()) return std::numeric_limits<double>::infinity();
  return apart.cols() == 0 ? 0.0 : std::sqrt(apart.squaredNorm() / static_cast<double>(apart.cols()));
}

DistanceAt distance_at(const Box& box, const State& a, const State& b) {
  DistanceAt found{.time = a.time, .rms = rms_distance(box, a, b)};
  for (Eigen::Index i = 0; i < a.positions.cols(); ++i) {
    const double distance = displacement(box, a, b, i).norm();
    if (distance <= found.largest) continue;
    found.largest = distance;
    found.disk = static_cast<std::int32_t>(i);
  }
  return found;
}

std::optional<DistanceAt> departure(const std::vector<DistanceAt>& distances, double diameter) {
  const auto parted = [&](const DistanceAt& at) { return at.rms > parted_diameters * diameter; };
  const auto first = std::find_if(distances.begin(), distances.end(), parted);
  return first == distances.end() ? std::nullopt : std::optional(*first);
}

std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t rows = std::min(count, most);
  for (std::size_t k = 0; k < rows; ++k) chosen.push_back(rows == 1 ? 0 : (k * (count - 1) + (rows - 1) / 2) / (rows - 1));
  return chosen;
}

}  // namespace carom
