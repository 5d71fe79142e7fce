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

DisksAtRest::Range DisksAtRest::cells_near(const Layer& layer, int axis, double x, double radius) const {
  const double reach = (radius + std::ldexp(2.0, layer.exponent)) * farthest_;
  Range range{cell_of(layer, axis, x - reach), cell_of(layer, axis, x + reach)};
  if (box_.periodic(axis)) return range;
  range.from = std::clamp<std::int64_t>(range.from, 0, layer.cells[axis] - 1);
  range.to = std::clamp<std::int64_t>(range.to, 0, layer.cells[axis] - 1);
  return range;
}

template <class F>
bool DisksAtRest::any_in(const Layer& layer, std::int64_t x, std::int64_t y, const Eigen::Vector2d& position, F&& f) const {
  // On periodic axes cell x is cell x - n * cells, n box lengths further on.
  const auto boxes_beyond = [](std::int64_t cell, std::int64_t cells) {
    if (cell >= 0 && cell < cells) return std::int64_t{0};
    return cell >= 0 ? cell / cells : (cell + 1) / cells - 1;
  };
  const std::int64_t n[2] = {boxes_beyond(x, layer.cells[0]), boxes_beyond(y, layer.cells[1])};
  const std::int64_t cell = (y - n[1] * layer.cells[1]) * layer.cells[0] + (x - n[0] * layer.cells[0]);
  for (std::int32_t j = layer.first[static_cast<std::size_t>(cell)]; j != none; j = next_[static_cast<std::size_t>(j)]) {
    const Eigen::Vector2d& other = position_[static_cast<std::size_t>(j)];
    if (f(j, Eigen::Vector2d(way(box_, 0, other[0], n[0], position[0]), way(box_, 1, other[1], n[1], position[1])))) return true;
  }
  return false;
}

bool DisksAtRest::overlaps(const Eigen::Vector2d& position, std::int32_t i) const {
  const double radius = radius_[static_cast<std::size_t>(i)];
  const auto overlaps_disk = [&](std::int32_t j, const Eigen::Vector2d& apart) {
    if (j == i) return false;
    const double sigma = (radius + radius_[static_cast<std::size_t>(j)]) * scales_.of_disks(i, j);
    // Squares say it of most pairs; roots alone say it of those that touch by rounding, as deepest() does.
    const double square = apart.squaredNorm(), contact = sigma * sigma;
    const bool is_in_range = contact > 1e-290 && contact < 1e290;
    if (is_in_range && square < contact * (1.0 - 1e-12)) return true;
    if (is_in_range && square > contact * (1.0 + 1e-12)) return false;
    return (sigma - apart.stableNorm()) / sigma > 0.0;
  };
  for (const Layer& layer : layers_) {
    // Most places are taken by a disk of the same cell.
    const std::int64_t own[2] = {std::clamp<std::int64_t>(cell_of(layer, 0, position[0]), 0, layer.cells[0] - 1),
                                 std::clamp<std::int64_t>(cell_of(layer, 1, position[1]), 0, layer.cells[1] - 1)};
    if (any_in(layer, own[0], own[1], position, overlaps_disk)) return true;
    const Range xs = cells_near(layer, 0, position[0], radius), ys = cells_near(layer, 1, position[1], radius);
    for (std::int64_t y = ys.from; y <= ys.to; ++y)
      for (std::int64_t x = xs.from; x <= xs.to; ++x)
        if ((x != own[0] || y != own[1]) && any_in(layer, x, y, position, overlaps_disk)) return true;
  }
  return false;
}

DisksAtRest::Neighbour DisksAtRest::deepest(const Eigen::Vector2d& position, std::int32_t i, bool larger_only,
                                            const Eigen::Vector2d& remainder) const {
  Neighbour found{none, 0.0};
  const double radius = radius_[static_cast<std::size_t>(i)];
  const int own = std::ilogb(radius);
  for (const Layer& layer : layers_) {
    if (larger_only && layer.exponent < own) break;
    const Range xs = cells_near(layer, 0, position[0], radius), ys = cells_near(layer, 1, position[1], radius);
    for (std::int64_t y = ys.from; y <= ys.to; ++y)
      for (std::int64_t x = xs.from; x <= xs.to; ++x)
        (void)any_in(layer, x, y, position, [&](std::int32_t j, Eigen::Vector2d apart) {
          if (j == i) return false;
          const double sigma = (radius + radius_[static_cast<std::size_t>(j)]) * scales_.of_disks(i, j);
          if (!remainder_.empty()) apart += remainder_[static_cast<std::size_t>(j)] - remainder;
          const double overlap = (sigma - apart.stableNorm()) / sigma;
          if (overlap > found.relative_overlap) found = {j, overlap};
          return false;
        });
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
