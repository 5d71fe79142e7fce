#pragma once
// Which of many rectangles a path may meet: a grid over the box, each of whose bins lists the rectangles that reach into it. A
// path is followed piece by piece, so that a long one costs the bins along it. What is found here is only who is asked, never
// what is answered: the search is in double precision, with margins above the rounding of any engine, and leaves no trace in the
// bits.

#include <carom/box.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

struct Rectangle {
  Eigen::Vector2d lower;
  Eigen::Vector2d upper;
};

/// r + v t + g t^2/2 for 0 <= t <= until, with a disk of radius + expansion t round it.
struct SearchPath {
  Eigen::Vector2d r;
  Eigen::Vector2d v;
  Eigen::Vector2d g;
  double radius;
  double expansion;
  double until;
  double rounding;  ///< of the number type that contacts are computed in
};

class RectangleBins {
 public:
  using Image = std::array<std::int64_t, 2>;  ///< box lengths by which a rectangle is moved

  /// The rectangles are known by their places in `rectangles`; they may stick out of the box.
  RectangleBins(const Box& box, const std::vector<Rectangle>& rectangles);

  /// Calls visit(rectangle, image) for all that the path may meet, the pieces of the path in their order, and met_by(t) after
  /// each, when every rectangle that may be met until time t has been visited. Ends where that returns true, at `until`, or, if
  /// that is infinite, where the path leaves the box across a wall or after `far` box lengths. An image may be visited several
  /// times.
  template <class Visit, class MetBy>
  void follow(const SearchPath& path, Visit&& visit, MetBy&& met_by) const {
    const double until = end_of(path);
    for (double from = 0.0;;) {
      const double to = end_of_piece(path, from, until);
      visit_bins(range_of(path, from, to), visit);
      if (to >= until || met_by(to)) return;
      from = to;
    }
  }

  /// The length over which a path without end is searched, in lengths of the box: 10^4. No position is known to better than 1e-12
  /// of the box after that.
  static constexpr double far = 1e4;

  [[nodiscard]] std::size_t bytes() const { return begin_.capacity() * sizeof(std::size_t) + items_.capacity() * sizeof(Item); }

 private:
  struct Item {
    std::int32_t rectangle;
    std::array<std::int32_t, 2> image;  ///< which image of it reaches into the bin, where that is inside the box
    std::array<std::int32_t, 2> first;  ///< the lowest column and row that this image reaches into
  };
  /// Columns and rows from first to last; those of all images count on, beyond periodic edges.
  struct Range {
    std::array<std::int64_t, 2> first;
    std::array<std::int64_t, 2> last;
  };
  struct Place {
    std::int64_t bin;
    std::int64_t image;
  };

  [[nodiscard]] double end_of(const SearchPath& path) const;
  [[nodiscard]] double end_of_piece(const SearchPath& path, double from, double until) const;
  [[nodiscard]] Range range_of(const SearchPath& path, double from, double to) const;
  [[nodiscard]] Range range_of(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper) const;
  [[nodiscard]] Place place(int axis, std::int64_t line) const;
  [[nodiscard]] std::size_t index(std::int64_t column, std::int64_t row) const;
  void choose_counts(const std::vector<Rectangle>& rectangles);
  void set_counts(std::int64_t columns, std::int64_t rows);

  template <class Visit>
  void visit_bins(const Range& range, Visit& visit) const {
    for (std::int64_t row = range.first[1]; row <= range.last[1]; ++row)
      for (std::int64_t column = range.first[0]; column <= range.last[0]; ++column) {
        const std::array<std::int64_t, 2> here{column, row};
        const std::array<Place, 2> places{place(0, column), place(1, row)};
        const std::size_t bin = index(places[0].bin, places[1].bin);
        for (std::size_t k = begin_[bin]; k < begin_[bin + 1]; ++k) {
          const Item& item = items_[k];
          bool lowest = true;  // of all bins of the range that this image reaches into: it is visited once
          Image image{};
          for (std::size_t a = 0; a < 2; ++a) {
            lowest = lowest && here[a] == std::max(range.first[a], item.first[a] + places[a].image * count_[a]);
            image[a] = item.image[a] + places[a].image;
          }
          if (lowest) visit(item.rectangle, image);
        }
      }
  }

  Box box_;
  std::array<std::int64_t, 2> count_{1, 1};
  Eigen::Vector2d width_ = Eigen::Vector2d::Zero();
  std::vector<std::size_t> begin_;  ///< of each bin's items, and the end of the last one's
  std::vector<Item> items_;
};

}  // namespace carom
