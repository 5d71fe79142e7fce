#include "neighbours/disks_at_rest.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {

namespace {

constexpr std::int32_t none = -1;

/// x + n * length - y along an axis, without rounding at the size of the box where x and y lie near opposite edges.
double way(const Box& box, int axis, double x, std::int64_t n, double y) {
  const double lower = box.lower[axis], upper = box.upper[axis];
  if (n == 0) return x - y;
  if (n == -1) return (x - upper) + (lower - y);
  if (n == 1) return (x - lower) + (upper - y);
  return x + static_cast<double>(n) * box.lengths()[axis] - y;
}

}  // namespace

DisksAtRest::DisksAtRest(const Box& box, const std::vector<double>& radius, const ContactScales<double>& scales)
    : box_(box),
      radius_(radius),
      scales_(scales),
      farthest_(scales.largest()),
      next_(radius.size(), none),
      position_(radius.size()) {
  for (const double r : radius) {
    const int exponent = std::ilogb(r);
    auto layer = std::find_if(layers_.begin(), layers_.end(), [&](const Layer& l) { return l.exponent == exponent; });
    if (layer == layers_.end()) {
      layers_.emplace_back().exponent = exponent;
      layer = layers_.end() - 1;
    }
    ++layer->disks;
  }
  std::sort(layers_.begin(), layers_.end(), [](const Layer& a, const Layer& b) { return a.exponent > b.exponent; });
  for (Layer& layer : layers_) {
    // Two diameters of the smallest disk of the layer are one of the next: neighbours lie in adjacent cells. A sparse
    // layer has no more cells than disks.
    const double area = box.lengths()[0] * (box.lengths()[1] / static_cast<double>(layer.disks));
    const double width = std::max(std::ldexp(4.0, layer.exponent), std::sqrt(area));
    for (int a = 0; a < 2; ++a) {
      const double cells = std::floor(box.lengths()[a] / width);
      layer.cells[a] = static_cast<std::int64_t>(std::clamp(cells, 1.0, 4.0 * static_cast<double>(layer.disks)));
      layer.width[a] = box.lengths()[a] / static_cast<double>(layer.cells[a]);
    }
    layer.first.assign(static_cast<std::size_t>(layer.cells[0] * layer.cells[1]), none);
  }
}

std::int64_t DisksAtRest::cell_of(const Layer& layer, int axis, double x) const {
  return static_cast<std::int64_t>(std::floor((x - box_.lower[axis]) / layer.width[axis]));
}

void DisksAtRest::insert(std::int32_t i, const Eigen::Vector2d& position, const Eigen::Vector2d& remainder) {
  const auto index = static_cast<std::size_t>(i);
  position_[index] = position;
  if (remainder_.empty() && !remainder.isZero(0.0)) remainder_.resize(position_.size(), Eigen::Vector2d::Zero());
  if (!remainder_.empty()) remainder_[index] = remainder;
  const int exponent = std::ilogb(radius_[index]);
  Layer& layer = *std::find_if(layers_.begin(), layers_.end(), [&](const Layer& l) { return l.exponent == exponent; });
  std::int64_t cell[2];
  for (int a = 0; a < 2; ++a) cell[a] = std::clamp<std::int64_t>(cell_of(layer, a, position[a]), 0, layer.cells[a] - 1);
  std::int32_t& first = layer.first[static_cast<std::size_t>(cell[1] * layer.cells[0] + cell[0])];
  next_[index] = std::exchange(first, i);
}

DisksAtRest::Neighbour DisksAtRest::deepest(const Eigen::Vector2d& position, std::int32_t i, bool larger_only,
                                            const Eigen::Vector2d& remainder) const {
  Neighbour found{none, 0.0};
  const double radius = radius_[static_cast<std::size_t>(i)];
  const int own = std::ilogb(radius);
  for (const Layer& layer : layers_) {
    if (larger_only && layer.exponent < own) break;
    const double reach = (radius + std::ldexp(2.0, layer.exponent)) * farthest_;
    std::int64_t from[2];
    std::int64_t to[2];
    for (int a = 0; a < 2; ++a) {
      from[a] = cell_of(layer, a, position[a] - reach);
      to[a] = cell_of(layer, a, position[a] + reach);
      if (box_.periodic(a)) continue;
      from[a] = std::clamp<std::int64_t>(from[a], 0, layer.cells[a] - 1);
      to[a] = std::clamp<std::int64_t>(to[a], 0, layer.cells[a] - 1);
    }
    for (std::int64_t y = from[1]; y <= to[1]; ++y) {
      for (std::int64_t x = from[0]; x <= to[0]; ++x) {
        // On periodic axes cell x is cell x - n * cells, n box lengths further on.
        const std::int64_t n[2] = {x >= 0 ? x / layer.cells[0] : (x + 1) / layer.cells[0] - 1,
                                   y >= 0 ? y / layer.cells[1] : (y + 1) / layer.cells[1] - 1};
        const std::int64_t cell = (y - n[1] * layer.cells[1]) * layer.cells[0] + (x - n[0] * layer.cells[0]);
        for (std::int32_t j = layer.first[static_cast<std::size_t>(cell)]; j != none; j = next_[static_cast<std::size_t>(j)]) {
          if (j == i) continue;
          const double sigma = (radius + radius_[static_cast<std::size_t>(j)]) * scales_.of_disks(i, j);
          const Eigen::Vector2d& other = position_[static_cast<std::size_t>(j)];
          Eigen::Vector2d apart(way(box_, 0, other[0], n[0], position[0]), way(box_, 1, other[1], n[1], position[1]));
          if (!remainder_.empty()) apart += remainder_[static_cast<std::size_t>(j)] - remainder;
          const double distance = apart.stableNorm();
          const double overlap = (sigma - distance) / sigma;
          if (overlap > found.relative_overlap) found = {j, overlap};
        }
      }
    }
  }
  return found;
}

DeepestOverlap deepest_overlap(const Box& box, const std::vector<double>& radius, const Eigen::Matrix2Xd& positions,
                               const Eigen::Matrix2Xd& remainders, const ContactScales<double>& scales) {
  const auto remainder = [&](Eigen::Index i) -> Eigen::Vector2d {
    return remainders.cols() > 0 ? Eigen::Vector2d(remainders.col(i)) : Eigen::Vector2d::Zero();
  };
  DisksAtRest disks(box, radius, scales);
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    disks.insert(static_cast<std::int32_t>(i), positions.col(column), remainder(column));
  }
  DeepestOverlap deepest;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const auto found = disks.deepest(positions.col(id), id, true, remainder(id));
    if (found.relative_overlap > deepest.relative)
      deepest = {found.relative_overlap, std::min(id, found.disk), std::max(id, found.disk)};
  }
  return deepest;
}

DeepestOverlap first_overlap(const Box& box, const std::vector<double>& radius, const std::vector<Eigen::Vector2d>& positions,
                             double tolerance, const ContactScales<double>& scales) {
  DisksAtRest disks(box, radius, scales);
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const auto found = disks.deepest(positions[i], id);
    if (found.relative_overlap > tolerance) return {found.relative_overlap, found.disk, id};
    disks.insert(id, positions[i]);
  }
  return {};
}

}  // namespace carom
