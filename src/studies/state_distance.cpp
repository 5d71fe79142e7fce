#include "studies/state_distance.hpp"

#include "core/nearest_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

/// Returns the displacement of disk i from state b to state a.
Eigen::Vector2d displacement(const Box& box, const State& a, const State& b, Eigen::Index i) {
  // The doubles of two disks that are close differ by no rounding; the remainders are added to that.
  Eigen::Vector2d apart = a.positions.col(i) - b.positions.col(i);
  if (a.shear_displacement != 0.0) apart.x() -= a.shear_displacement * std::round(apart.y() / box.lengths().y());
  apart = nearest_image(box, apart);
  if (a.remainders.cols() > i) apart += a.remainders.col(i);
  if (b.remainders.cols() > i) apart -= b.remainders.col(i);
  return apart;
}

Eigen::Matrix2Xd displacements(const Box& box, const State& a, const State& b) {
  Eigen::Matrix2Xd apart(2, a.positions.cols());
  for (Eigen::Index i = 0; i < apart.cols(); ++i) apart.col(i) = displacement(box, a, b, i);
  return apart;
}

double rms(const Eigen::Matrix2Xd& apart) {
  if (!apart.allFinite()) return std::numeric_limits<double>::infinity();
  return apart.cols() == 0 ? 0.0 : std::sqrt(apart.squaredNorm() / static_cast<double>(apart.cols()));
}

}  // namespace

double largest_distance(const Box& box, const State& a, const State& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.positions.cols(); ++i) {
    const double distance = displacement(box, a, b, i).norm();
    if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, distance);
  }
  return largest;
}

double rms_distance(const Box& box, const State& a, const State& b) { return rms(displacements(box, a, b)); }

DistanceAt distance_at(const Box& box, const State& a, const State& b) {
  const Eigen::Matrix2Xd apart = displacements(box, a, b);
  DistanceAt found{.time = a.time, .rms = rms(apart)};
  for (Eigen::Index i = 0; i < apart.cols(); ++i) {
    const double distance = apart.col(i).norm();
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

}  // namespace carom
