// Which rectangles a path may meet.

#include "core/rectangle_bins.hpp"

#include "core/fall_time.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// A margin as a fraction of the box: far above the rounding of bin numbers, far below anything that costs time.
constexpr double margin = 1e-9;

}  // namespace

RectangleBins::RectangleBins(const Box& box, const std::vector<Rectangle>& rectangles) : box_(box) {
  choose_counts(rectangles);
  const auto for_bins = [&](auto&& act) {
    for (std::size_t o = 0; o < rectangles.size(); ++o) {
      const Range range = range_of(rectangles[o].lower, rectangles[o].upper);
      for (std::int64_t row = range.first[1]; row <= range.last[1]; ++row)
        for (std::int64_t column = range.first[0]; column <= range.last[0]; ++column) act(o, range, column, row);
    }
  };
  begin_.assign(static_cast<std::size_t>(count_[0] * count_[1]) + 1, 0);
  for_bins([&](std::size_t, const Range&, std::int64_t column, std::int64_t row) {
    ++begin_[index(place(0, column).bin, place(1, row).bin) + 1];
  });
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  items_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for_bins([&](std::size_t o, const Range& range, std::int64_t column, std::int64_t row) {
    const std::array<Place, 2> places{place(0, column), place(1, row)};
    Item& item = items_[next[index(places[0].bin, places[1].bin)]++];
    item.rectangle = static_cast<std::int32_t>(o);
    for (std::size_t a = 0; a < 2; ++a) {
      item.image[a] = static_cast<std::int32_t>(-places[a].image);
      item.first[a] = static_cast<std::int32_t>(range.first[a] - places[a].image * count_[a]);
    }
  });
}

/// Bins about as many as rectangles; fewer where long ones would fill too many of them.
void RectangleBins::choose_counts(const std::vector<Rectangle>& rectangles) {
  const double number = std::max<double>(1.0, static_cast<double>(rectangles.size()));
  const Eigen::Vector2d lengths = box_.lengths();
  for (double width = std::sqrt(box_.area() / number);; width *= 1.5) {
    const auto count = [&](int a) {
      return static_cast<std::int64_t>(std::clamp(std::floor(lengths[a] / width), 1.0, 4.0 * number));
    };
    set_counts(count(0), count(1));
    if (count_[0] * count_[1] == 1) return;
    double items = 0.0;
    for (const Rectangle& b : rectangles) {
      const Range range = range_of(b.lower, b.upper);
      items += static_cast<double>((range.last[0] - range.first[0] + 1) * (range.last[1] - range.first[1] + 1));
    }
    if (items <= 32.0 * number + 256.0) return;
  }
}

void RectangleBins::set_counts(std::int64_t columns, std::int64_t rows) {
  count_ = {columns, rows};
  width_ = box_.lengths().cwiseQuotient(Eigen::Vector2d(static_cast<double>(columns), static_cast<double>(rows)));
}

double RectangleBins::end_of(const SearchPath& path) const {
  if (path.until < infinity<double>) return path.until;
  double until = infinity<double>;
  const Eigen::Vector2d lengths = box_.lengths();
  for (int a = 0; a < 2; ++a) {
    if (!box_.periodic(a)) {
      until = std::min(until, fall_time(path.r[a] - box_.lower[a], path.v[a], path.g[a]));
      until = std::min(until, fall_time(box_.upper[a] - path.r[a], -path.v[a], -path.g[a]));
    } else if (path.v[a] != 0.0) {
      until = std::min(until, far * lengths.maxCoeff() / path.v.cwiseAbs().maxCoeff());
    }
  }
  if (path.expansion > 0.0) until = std::min(until, 2.0 * lengths.sum() / path.expansion);  // has filled the box by then
  return until;
}

/// A piece is about a bin long.
double RectangleBins::end_of_piece(const SearchPath& path, double from, double until) const {
  double time = infinity<double>;
  const Eigen::Vector2d v = path.v + from * path.g;
  for (int a = 0; a < 2; ++a) {
    if (v[a] != 0.0) time = std::min(time, width_[a] / std::abs(v[a]));
    if (path.g[a] != 0.0) time = std::min(time, std::sqrt(width_[a] / std::abs(path.g[a])));
  }
  if (path.expansion > 0.0) time = std::min(time, width_.minCoeff() / path.expansion);
  return std::min(until, from + std::max(time, 1e-12 * from));
}

RectangleBins::Range RectangleBins::range_of(const SearchPath& path, double from, double to) const {
  const auto at = [&path](double t) { return Eigen::Vector2d(path.r + t * (path.v + t / 2 * path.g)); };
  const bool rests = path.v.isZero(0.0) && path.g.isZero(0.0);  // and `to` may be infinite
  const Eigen::Vector2d first = rests ? path.r : at(from);
  const Eigen::Vector2d last = rests ? path.r : at(to);
  const double moving = rests && path.expansion == 0.0 ? 0.0 : to;
  const double reach = path.radius + path.expansion * moving;
  const double sag = path.g.norm() * (moving - from) * (moving - from) / 8;  // of a parabola, from its chord
  const double way = path.r.norm() + box_.lengths().sum() + moving * (path.v.norm() + moving / 2 * path.g.norm()) + reach;
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(reach + sag + 64 * path.rounding * way);
  return range_of(first.cwiseMin(last) - around, first.cwiseMax(last) + around);
}

RectangleBins::Range RectangleBins::range_of(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper) const {
  Range range{};
  for (int a = 0; a < 2; ++a) {
    const auto k = static_cast<std::size_t>(a);
    const double around = margin * box_.lengths()[a];
    range.first[k] = static_cast<std::int64_t>(std::floor((lower[a] - around - box_.lower[a]) / width_[a]));
    range.last[k] = static_cast<std::int64_t>(std::floor((upper[a] + around - box_.lower[a]) / width_[a]));
    if (box_.periodic(a)) continue;
    range.first[k] = std::clamp<std::int64_t>(range.first[k], 0, count_[k] - 1);  // what is beyond a wall is listed at it
    range.last[k] = std::clamp<std::int64_t>(range.last[k], 0, count_[k] - 1);
  }
  return range;
}

RectangleBins::Place RectangleBins::place(int axis, std::int64_t line) const {
  const std::int64_t count = count_[static_cast<std::size_t>(axis)];
  const std::int64_t image = line >= 0 ? line / count : -((count - 1 - line) / count);
  return {line - image * count, image};
}

std::size_t RectangleBins::index(std::int64_t column, std::int64_t row) const {
  return static_cast<std::size_t>(row * count_[0] + column);
}

}  // namespace carom
