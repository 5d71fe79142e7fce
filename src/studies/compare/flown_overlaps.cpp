#include "studies/compare/flown_overlaps.hpp"

#include "observe/close_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace carom {

namespace {

/// When a pair at separation r, moving by w per time, is nearer than `reach`: within [0, lasting].
std::optional<std::pair<double, double>> nearer_than(double reach, const Eigen::Vector2d& r, const Eigen::Vector2d& w,
                                                     double lasting) {
  const double a = w.squaredNorm(), b = r.dot(w), c = r.squaredNorm() - reach * reach;
  if (a == 0.0) return c < 0.0 ? std::optional(std::pair(0.0, lasting)) : std::nullopt;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0)) return {};
  const double root = std::sqrt(discriminant);
  const double from = std::max(0.0, (-b - root) / a), to = std::min(lasting, (-b + root) / a);
  return from < to ? std::optional(std::pair(from, to)) : std::nullopt;
}

/// Returns the box with room beyond its walls, as if it continued: no pair is near another one through that.
Box without_walls(Box box, double room) {
  for (int axis = 0; axis < 2; ++axis) {
    if (box.periodic(axis)) continue;
    box.boundary[static_cast<std::size_t>(axis)] = Boundary::periodic;
    box.lower[axis] -= room;
    box.upper[axis] += room;
  }
  return box;
}

}  // namespace

FlownOverlaps::FlownOverlaps(const Box& box, const Disks& disks) : box_(box), disks_(disks) {
  for (const double radius : disks.radius) largest_ = std::max(largest_, 2.0 * radius);
}

void FlownOverlaps::fly(const Eigen::Matrix2Xd& positions, const Eigen::Matrix2Xd& velocities, double begin, double lasting) {
  const double farthest = positions.cols() == 0 ? 0.0 : velocities.colwise().norm().maxCoeff() * lasting;
  const double reach = largest_ + 2.0 * farthest;
  std::map<Pair, std::size_t> lasting_on;
  std::vector<Overlap> begun;
  const auto look = [&](Eigen::Index one, Eigen::Index other, const Eigen::Vector2d& apart) {
    const Eigen::Index i = std::min(one, other), j = std::max(one, other);
    const Eigen::Vector2d w = velocities.col(one) - velocities.col(other);
    const double sigma = disks_.radius[static_cast<std::size_t>(i)] + disks_.radius[static_cast<std::size_t>(j)];
    const auto span = nearer_than(sigma * (1.0 - overlap_tolerance), apart, w, lasting);
    if (!span) return;
    const auto& [from, to] = *span;
    const double nearest = w.squaredNorm() > 0.0 ? std::clamp(-apart.dot(w) / w.squaredNorm(), from, to) : from;
    const double depth = 1.0 - (apart + nearest * w).norm() / sigma;
    const Pair pair{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
    // An overlap that reached the end of the last stretch may, by rounding, begin a little after the beginning of this one.
    const auto known = from <= 1e-9 * lasting ? open_.find(pair) : open_.end();
    if (known != open_.end()) {
      Overlap& overlap = found_[known->second];
      overlap.end = begin + to;
      overlap.depth = std::max(overlap.depth, depth);
      if (to == lasting) lasting_on.insert(*known);
    } else {
      begun.push_back({pair.first, pair.second, begin + from, begin + to, depth});
      if (to == lasting) lasting_on.emplace(pair, std::numeric_limits<std::size_t>::max());
    }
  };
  // Past walls the room keeps disks apart, also where a method lets them fly through by as much as one stretch.
  for_each_close_pair(without_walls(box_, reach), positions, reach, look);
  std::sort(begun.begin(), begun.end(), [](const Overlap& a, const Overlap& b) {
    return a.begin < b.begin || (a.begin == b.begin && Pair(a.first, a.second) < Pair(b.first, b.second));
  });
  for (const Overlap& overlap : begun) {
    const auto open = lasting_on.find({overlap.first, overlap.second});
    if (open != lasting_on.end()) open->second = found_.size();
    found_.push_back(overlap);
  }
  open_ = std::move(lasting_on);
}

}  // namespace carom
