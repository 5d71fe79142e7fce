#include "parallel/box_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

constexpr std::int64_t all = std::int64_t{1} << 32;

/// A place along an axis, and what the disk there costs.
struct Weight {
  std::int64_t place;
  double cost;
};

/// Where to cut a line so that each piece has its share of the costs: `shares` parts of them. Sorts the weights.
std::vector<std::int64_t> cuts(std::vector<Weight>& weights, std::span<const std::size_t> shares) {
  std::sort(weights.begin(), weights.end(), [](const Weight& a, const Weight& b) { return a.place < b.place; });
  double total = 0.0, so_far = 0.0;
  for (const Weight& weight : weights) total += weight.cost;
  std::size_t parts = 0, before = 0, next = 0;
  for (const std::size_t share : shares) parts += share;
  std::vector<std::int64_t> ends;
  for (const std::size_t share : shares) {
    before += share;
    const double fraction = static_cast<double>(before) / static_cast<double>(parts);
    while (next < weights.size() && so_far < fraction * total) so_far += weights[next++].cost;
    std::int64_t end =
        next < weights.size() ? weights[next].place : static_cast<std::int64_t>(fraction * static_cast<double>(all));
    if (before == parts) end = all;
    ends.push_back(std::max(end, ends.empty() ? 0 : ends.back()));
  }
  return ends;
}

}  // namespace

BoxParts::BoxParts(std::size_t parts, std::span<const NeighbourhoodCentre> centres, std::array<double, 2> step,
                   const Costs* costs)
    : step_(step) {
  const auto cost = [&](NeighbourhoodCentre centre) {
    return costs == nullptr ? 1.0 : costs->of_a_disk[costs->before.owner(centre)];
  };
  // As many columns as make the parts nearly square.
  const double aspect = step[0] / step[1];
  const auto most = static_cast<double>(parts);
  const auto columns = static_cast<std::size_t>(std::clamp(std::round(std::sqrt(most * aspect)), 1.0, most));
  std::vector<std::size_t> rows(columns, parts / columns);
  for (std::size_t k = 0; k < parts % columns; ++k) ++rows[k];

  std::vector<Weight> weights;
  weights.reserve(centres.size());
  for (const NeighbourhoodCentre centre : centres) weights.push_back({place(0, centre.x), cost(centre)});
  columns_ = cuts(weights, rows);
  std::int64_t left = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    weights.clear();
    for (const NeighbourhoodCentre centre : centres)
      if (place(0, centre.x) >= left && place(0, centre.x) < columns_[c]) weights.push_back({place(1, centre.y), cost(centre)});
    first_.push_back(parts_.size());
    std::int64_t bottom = 0;
    for (const std::int64_t top : cuts(weights, std::vector<std::size_t>(rows[c], 1))) {
      parts_.push_back({Range{left, columns_[c]}, Range{bottom, top}});
      bottom = top;
    }
    left = columns_[c];
  }
  first_.push_back(parts_.size());
}

std::size_t BoxParts::owner(NeighbourhoodCentre centre) const {
  std::size_t column = 0;
  while (place(0, centre.x) >= columns_[column]) ++column;
  std::size_t part = first_[column];
  while (place(1, centre.y) >= parts_[part][1].end) ++part;
  return part;
}

void BoxParts::set_reach(double reach) {
  cores_ = parts_;
  for (Part& core : cores_)
    for (std::size_t k = 0; k < 2; ++k) {
      const auto steps = static_cast<std::int64_t>(std::min(reach / step_[k], 0x1p33)) + 2;
      if (core[k].begin == 0 && core[k].end == all) continue;  // it reaches from one side of the box to the other
      core[k].begin += steps;
      core[k].end -= steps;
    }
}

std::int64_t BoxParts::outside(std::int64_t at, const Range& range) {
  if (at >= range.begin && at < range.end) return 0;
  const std::int64_t below = (range.begin - at + all) % all, above = (at - range.end + all) % all + 1;
  return std::min(below, above);
}

double BoxParts::outside(NeighbourhoodCentre centre, std::size_t part) const {
  const Part& of = parts_[part];
  return std::max(static_cast<double>(outside(place(0, centre.x), of[0])) * step_[0],
                  static_cast<double>(outside(place(1, centre.y), of[1])) * step_[1]);
}

std::int64_t BoxParts::gap(const Range& a, const Range& b) {
  if (a.begin < b.end && b.begin < a.end) return 0;
  return std::min((b.begin - a.end + all) % all, (a.begin - b.end + all) % all);
}

double BoxParts::thinnest() const {
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_)
    for (std::size_t k = 0; k < 2; ++k)
      thinnest = std::min(thinnest, static_cast<double>(part[k].end - part[k].begin) * step_[k]);
  return thinnest;
}

std::size_t BoxParts::most_neighbours(double reach) const {
  std::size_t most = 0;
  for (std::size_t a = 0; a < count(); ++a) {
    std::size_t neighbours = 0;
    for (std::size_t b = 0; b < count(); ++b) neighbours += static_cast<std::size_t>(b != a && adjacent(a, b, reach));
    most = std::max(most, neighbours);
  }
  return most;
}

bool BoxParts::adjacent(std::size_t a, std::size_t b, double reach) const {
  for (std::size_t k = 0; k < 2; ++k)
    if (static_cast<double>(gap(parts_[a][k], parts_[b][k])) * step_[k] > reach) return false;
  return true;
}

}  // namespace carom
