// Neighbour lists in a box whose images above slide past those below, against a comparison of all pairs while neighbourhoods move
// and images slide on: by the lists' own definition, and by geometry in double precision at many instants on the way.

#include "core/flight.hpp"
#include "neighbours/neighbour_lists.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace carom::test {
namespace {

TEST(BoxesBetween, CountsTheBoxesThatTheNearestImageIsAbove) {
  EXPECT_EQ(boxes_between(0, 0), 0);
  EXPECT_EQ(boxes_between(INT32_MAX, INT32_MIN), 1);
  EXPECT_EQ(boxes_between(INT32_MIN, INT32_MAX), -1);
  EXPECT_EQ(boxes_between(1 << 30, -(1 << 30) + 1), 0) << "a step less than half a box apart";
  EXPECT_EQ(boxes_between(1 << 30, -(1 << 30) - 1), 1) << "a step more";
  EXPECT_EQ(boxes_between(-(1 << 30), (1 << 30) + 1), -1);
}

class SlidingBox {
 public:
  SlidingBox(const Box& box, std::vector<double> radius, double half_width, std::uint64_t seed)
      : box_(box),
        axes_{FixedAxis(box, 0, 0.0), FixedAxis(box, 1, 0.0)},
        radius_(std::move(radius)),
        half_width_(half_width),
        random_(seed),
        lists_(axes_[0], axes_[1], radius_) {
    for (std::size_t i = 0; i < radius_.size(); ++i) centres_.push_back(anywhere());
    lists_.slide(0, 0.0);
    lists_.rebuild(half_width, centres_);
  }

  /// A new epoch. Displacement and way as parts of the length along x.
  void slide(double displacement, double way) {
    displacement_ = displacement * box_.lengths()[0];
    way_ = way * box_.lengths()[0];
    lists_.slide(static_cast<std::int64_t>(std::remainder(displacement, 1.0) * 0x1.fffffffffp63), way_);
  }

  void move_any() {
    const auto i = static_cast<std::int32_t>(unit() * static_cast<double>(radius_.size()));
    const std::vector<std::int32_t> before = list(i);
    const NeighbourhoodCentre to = anywhere();
    const auto returned = lists_.move_neighbourhood(i, to);
    centres_[static_cast<std::size_t>(i)] = to;
    std::vector<std::int32_t> fresh(returned.begin(), returned.end()), expected;
    for (std::size_t k = returned.size(); k < (returned.size() + 3) / 4 * 4; ++k) ASSERT_EQ(returned.data()[k], i) << "padding";
    std::sort(fresh.begin(), fresh.end());
    const std::vector<std::int32_t> after = list(i);
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(expected));
    ASSERT_EQ(fresh, expected) << "disk " << i;
  }

  void expect_lists_of_all_pairs() const {
    const auto count = static_cast<std::int32_t>(radius_.size());
    for (std::int32_t i = 0; i < count; ++i) {
      std::vector<std::int32_t> expected;
      for (std::int32_t j = 0; j < count; ++j) {
        if (i == j) continue;
        const bool near = lists_.near(i, j);
        if (near) expected.push_back(j);
        ASSERT_EQ(near, lists_.near(j, i));
        const double beyond = least_distance_beyond_contact(i, j);
        ASSERT_TRUE(near || beyond > 0.0) << "disks " << i << " and " << j << " may touch: " << beyond;
        // The slack: 1e-6 of the lengths on the safe side, single precision's 6e-8 a few times, four steps of the centres; and
        // the way of the images from one instant that is looked at to the next.
        const double sigma = radius_[static_cast<std::size_t>(i)] + radius_[static_cast<std::size_t>(j)];
        const double slack =
            4e-6 * (2.0 * half_width_ + sigma) + 8.0 * std::max(unit_of(0), unit_of(1)) + std::abs(way_) / instants;
        ASSERT_TRUE(!near || beyond < slack) << "disks " << i << " and " << j << " stay " << beyond << " apart";
      }
      ASSERT_EQ(list(i), expected) << "disk " << i;
    }
  }

  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

 private:
  static constexpr int instants = 32;

  /// Often at the edge of y, where all happens.
  NeighbourhoodCentre anywhere() {
    const double x = unit(), y = unit() < 0.6 ? std::fmod(1.0 + 0.2 * (unit() - 0.5), 1.0) : unit();
    const auto centre = [](double part) { return static_cast<std::int32_t>(std::floor((part - 0.5) * 0x1p32)); };
    return {centre(x), centre(y)};
  }
  [[nodiscard]] double unit_of(int axis) const { return axes_[axis].unit * 0x1p32; }

  /// The least while images slide: gap of the two squares, less the contact distance, to whichever image is nearest.
  [[nodiscard]] double least_distance_beyond_contact(std::int32_t i, std::int32_t j) const {
    const NeighbourhoodCentre a = centres_[static_cast<std::size_t>(i)], b = centres_[static_cast<std::size_t>(j)];
    const Eigen::Vector2d length = box_.lengths();
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= instants; ++k)
      for (int up = -1; up <= 1; ++up) {
        double x =
            (static_cast<double>(a.x) - static_cast<double>(b.x)) * unit_of(0) - up * (displacement_ + way_ * k / instants);
        x -= length[0] * std::round(x / length[0]);
        const double y = (static_cast<double>(a.y) - static_cast<double>(b.y)) * unit_of(1) - up * length[1];
        least = std::min(
            least, std::hypot(std::max(std::abs(x) - 2.0 * half_width_, 0.0), std::max(std::abs(y) - 2.0 * half_width_, 0.0)));
      }
    return least - radius_[static_cast<std::size_t>(i)] - radius_[static_cast<std::size_t>(j)];
  }

  [[nodiscard]] std::vector<std::int32_t> list(std::int32_t i) const {
    std::vector<std::int32_t> ids(lists_.ids(i), lists_.ids(i) + lists_.count(i));
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  Box box_;
  FixedAxis axes_[2];
  std::vector<double> radius_;
  double half_width_;
  std::mt19937_64 random_;
  NeighbourLists lists_;
  std::vector<NeighbourhoodCentre> centres_;
  double displacement_ = 0.0;
  double way_ = 0.0;
};

/// Images slide by up to what reach and way may be together, less than half of the box.
void expect_right_while_sliding(SlidingBox& box, double most, int epochs, int moves) {
  ASSERT_NO_FATAL_FAILURE(box.expect_lists_of_all_pairs());
  for (int k = 0; k < epochs; ++k) {
    box.slide(k % 4 == 0 ? 0.5 : box.unit(), k % 5 == 0 ? 0.0 : most * (2.0 * box.unit() - 1.0));
    ASSERT_NO_FATAL_FAILURE(box.expect_lists_of_all_pairs()) << "epoch " << k;
    for (int move = 0; move < moves; ++move) ASSERT_NO_FATAL_FAILURE(box.move_any()) << "epoch " << k << ", move " << move;
    ASSERT_NO_FATAL_FAILURE(box.expect_lists_of_all_pairs()) << "epoch " << k;
  }
}

TEST(ShearedNeighbourhoods, HaveListsOfAllPairsForEqualDisks) {
  SlidingBox box(box_of(12.0, 9.0, Boundary::periodic), std::vector<double>(40, 0.5), 0.3, 1);
  expect_right_while_sliding(box, 0.3, 8, 30);
}

TEST(ShearedNeighbourhoods, HaveListsOfAllPairsInFlatAndTallBoxes) {
  SlidingBox flat(box_of(200.0, 4.0, Boundary::periodic), std::vector<double>(40, 0.5), 0.1, 2);
  ASSERT_NO_FATAL_FAILURE(expect_right_while_sliding(flat, 0.45, 6, 30));
  SlidingBox tall(box_of(4.0, 200.0, Boundary::periodic), std::vector<double>(40, 0.5), 0.1, 3);
  ASSERT_NO_FATAL_FAILURE(expect_right_while_sliding(tall, 0.15, 6, 30));
}

TEST(ShearedNeighbourhoods, HaveListsOfAllPairsForRadiiFarApart) {
  std::vector<double> radius;
  for (int i = 0; i < 40; ++i) radius.push_back(i % 15 == 7 ? 2.0 : 0.05 * (1 + i % 7));
  SlidingBox box(box_of(20.0, 15.0, Boundary::periodic), radius, 0.2, 4);
  expect_right_while_sliding(box, 0.25, 6, 30);
}

}  // namespace
}  // namespace carom::test
