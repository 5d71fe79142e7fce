#include "parallel/box_parts.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

constexpr std::int64_t all = std::int64_t{1} << 32;

/// Where to cut a line so that each piece has its share of the places, which are sorted here. `shares` counts parts per piece.
std::vector<std::int64_t> cuts(std::vector<std::int64_t>& places, std::span<const std::size_t> shares) {
  std::sort(places.begin(), places.end());
  std::size_t total = 0, before = 0;
  for (const std::size_t share : shares) total += share;
  std::vector<std::int64_t> ends;
  for (const std::size_t share : shares) {
    before += share;
    const std::size_t k = places.size() * before / total;
    const std::int64_t even = all / static_cast<std::int64_t>(total) * static_cast<std::int64_t>(before);
    const std::int64_t end = before == total ? all : places.empty() ? even : places[std::min(k, places.size() - 1)];
    ends.push_back(std::max(end, ends.empty() ? 0 : ends.back()));
  }
  return ends;
}

}  // namespace

BoxParts::BoxParts(std::size_t parts, std::span<const NeighbourhoodCentre> centres, std::array<double, 2> step) : step_(step) {
  // As many columns as make the parts nearly square.
  const double aspect = step[0] / step[1];
  const auto most = static_cast<double>(parts);
  const auto columns = static_cast<std::size_t>(std::clamp(std::round(std::sqrt(most * aspect)), 1.0, most));
  std::vector<std::size_t> rows(columns, parts / columns);
  for (std::size_t k = 0; k < parts % columns; ++k) ++rows[k];

  std::vector<std::int64_t> places(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) places[i] = place(centres[i].x);
  columns_ = cuts(places, rows);
  std::int64_t left = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    places.clear();
    for (const NeighbourhoodCentre centre : centres)
      if (place(centre.x) >= left && place(centre.x) < columns_[c]) places.push_back(place(centre.y));
    first_.push_back(parts_.size());
    std::int64_t bottom = 0;
    for (const std::int64_t top : cuts(places, std::vector<std::size_t>(rows[c], 1))) {
      parts_.push_back({Range{left, columns_[c]}, Range{bottom, top}});
      bottom = top;
    }
    left = columns_[c];
  }
  first_.push_back(parts_.size());
}

std::size_t BoxParts::owner(NeighbourhoodCentre centre) const {
  std::size_t column = 0;
  while (place(centre.x) >= columns_[column]) ++column;
  std::size_t part = first_[column];
  while (place(centre.y) >= parts_[part][1].end) ++part;
  return part;
}

std::int64_t BoxParts::outside(std::int64_t at, const Range& range) {
  if (at >= range.begin && at < range.end) return 0;
  const std::int64_t below = (range.begin - at + all) % all, above = (at - range.end + all) % all + 1;
  return std::min(below, above);
}

double BoxParts::outside(NeighbourhoodCentre centre, std::size_t part) const {
  const Part& of = parts_[part];
  return std::max(static_cast<double>(outside(place(centre.x), of[0])) * step_[0],
                  static_cast<double>(outside(place(centre.y), of[1])) * step_[1]);
}

std::int64_t BoxParts::gap(const Range& a, const Range& b) {
  if (a.begin < b.end && b.begin < a.end) return 0;
  return std::min((b.begin - a.end + all) % all, (a.begin - b.end + all) % all);
}

bool BoxParts::adjacent(std::size_t a, std::size_t b, double reach) const {
  for (std::size_t k = 0; k < 2; ++k)
    if (static_cast<double>(gap(parts_[a][k], parts_[b][k])) * step_[k] > reach) return false;
  return true;
}

}  // namespace carom
