// Neighbour lists against a comparison of all pairs of neighbourhoods, while neighbourhoods move at random: by the lists' own
// definition, and by geometry in double precision.

#include "neighbours/neighbour_lists.hpp"
#include "core/flight.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace carom::test {
namespace {

/// Neighbourhoods in a box, and where they are.
class Neighbourhoods {
 public:
  Neighbourhoods(const Box& box, std::vector<double> radius, double half_width, std::uint64_t seed)
      : axes_{FixedAxis(box, 0, 0.0), FixedAxis(box, 1, 0.0)},
        box_(box),
        radius_(std::move(radius)),
        half_width_(half_width),
        random_(seed),
        lists_(axes_[0], axes_[1], radius_) {
    for (std::size_t i = 0; i < radius_.size(); ++i) centres_.push_back(anywhere());
    lists_.rebuild(half_width, centres_);
  }

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(radius_.size()); }
  [[nodiscard]] const NeighbourLists& lists() const { return lists_; }
  [[nodiscard]] std::vector<NeighbourhoodCentre>& centres() { return centres_; }
  void rebuild(double half_width) {
    half_width_ = half_width;
    lists_.rebuild(half_width, centres_);
  }

  /// Somewhere in the box; often at an edge, a corner or in the middle.
  NeighbourhoodCentre anywhere() { return at(unit() < 0.1 ? edge() : unit(), unit() < 0.1 ? edge() : unit()); }
  /// A place as parts of the box.
  NeighbourhoodCentre at(double x, double y) { return {centre(0, x), centre(1, y)}; }
  /// Up to some neighbourhood widths away, in the box where it has walls.
  NeighbourhoodCentre nearby(NeighbourhoodCentre from) {
    const auto moved = [this](int axis, std::int32_t centre) {
      const double way = 3.0 * half_width_ * (unit() - 0.5) * (unit() < 0.1 ? 10.0 : 1.0);
      const auto steps = static_cast<std::int64_t>(std::fmod(way / unit_of(axis), 0x1p31));
      const std::int64_t to = std::int64_t{centre} + steps;
      if (axes_[axis].periodic) return static_cast<std::int32_t>(static_cast<std::uint64_t>(to));
      const std::int64_t limit = axes_[axis].at(axes_[axis].upper) >> 32;
      return static_cast<std::int32_t>(std::clamp(to, -limit, limit));
    };
    return {moved(0, from.x), moved(1, from.y)};
  }

  /// Moves a neighbourhood; the indices that the call returns must be exactly those that are on the list and were not before.
  void move(std::int32_t i, NeighbourhoodCentre to) {
    const std::vector<std::int32_t> before = list(i);
    const auto returned = lists_.move_neighbourhood(i, to);
    std::vector<std::int32_t> fresh(returned.begin(), returned.end());
    centres_[static_cast<std::size_t>(i)] = to;
    for (std::size_t k = returned.size(); k < padded(returned.size()); ++k) ASSERT_EQ(returned.data()[k], i);
    std::sort(fresh.begin(), fresh.end());
    const std::vector<std::int32_t> after = list(i);
    std::vector<std::int32_t> expected;
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(expected));
    ASSERT_EQ(fresh, expected) << "disk " << i;
    ASSERT_EQ(lists_.centre(i).x, to.x);
    ASSERT_EQ(lists_.centre(i).y, to.y);
  }

  void expect_lists_of_all_pairs() const {
    std::uint64_t entries = 0;
    for (std::int32_t i = 0; i < count(); ++i) {
      std::vector<std::int32_t> expected;
      for (std::int32_t j = 0; j < count(); ++j) {
        if (i == j) continue;
        const bool near = lists_.near(i, j);
        if (near) expected.push_back(j);
        ASSERT_EQ(near, lists_.near(j, i));
        const double beyond = distance_beyond_contact(i, j);
        // The slack: 1e-6 of the lengths on the safe side, single precision's 6e-8 a few times, four steps of the centres.
        const double slack = 4e-6 * (2.0 * half_width_ + sigma(i, j)) + 6.0 * std::max(unit_of(0), unit_of(1));
        ASSERT_TRUE(near || beyond > 0.0) << "disks " << i << " and " << j << " may touch: " << beyond;
        ASSERT_TRUE(!near || beyond < slack) << "disks " << i << " and " << j << " are " << beyond << " apart";
      }
      ASSERT_EQ(list(i), expected) << "disk " << i;
      for (std::uint32_t k = lists_.count(i); k < padded(lists_.count(i)); ++k)
        ASSERT_EQ(lists_.ids(i)[k], i) << "padding of disk " << i;
      entries += lists_.count(i);
    }
    ASSERT_EQ(lists_.entries(), entries);
  }

  /// Eight at least, and a multiple of four.
  static std::size_t padded(std::size_t ids) { return std::max<std::size_t>((ids + 3) / 4 * 4, 8); }

  std::int32_t any() { return static_cast<std::int32_t>(unit() * count()); }
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

 private:
  double edge() {
    const double edges[] = {0.0, 0.5, 0.25, std::nextafter(1.0, 0.0)};
    return edges[static_cast<std::size_t>(4.0 * unit())];
  }
  [[nodiscard]] std::int32_t centre(int axis, double part) const {
    const double place = box_.lower[axis] + part * (box_.upper[axis] - box_.lower[axis]);
    return static_cast<std::int32_t>(axes_[axis].at(place) >> 32);
  }
  /// Length of a step of a centre.
  [[nodiscard]] double unit_of(int axis) const { return axes_[axis].unit * 0x1p32; }
  [[nodiscard]] double sigma(std::int32_t i, std::int32_t j) const {
    return radius_[static_cast<std::size_t>(i)] + radius_[static_cast<std::size_t>(j)];
  }

  /// Gap of the two squares, less the contact distance: not above zero where disks in them may touch. Nearest images by rounding.
  [[nodiscard]] double distance_beyond_contact(std::int32_t i, std::int32_t j) const {
    const NeighbourhoodCentre a = centres_[static_cast<std::size_t>(i)], b = centres_[static_cast<std::size_t>(j)];
    const double apart[2] = {(static_cast<double>(a.x) - static_cast<double>(b.x)) * unit_of(0),
                             (static_cast<double>(a.y) - static_cast<double>(b.y)) * unit_of(1)};
    double gap[2];
    for (int k = 0; k < 2; ++k) {
      double d = apart[k];
      if (axes_[k].periodic) d -= box_.lengths()[k] * std::round(d / box_.lengths()[k]);
      gap[k] = std::max(std::abs(d) - 2.0 * half_width_, 0.0);
    }
    return std::hypot(gap[0], gap[1]) - sigma(i, j);
  }

  [[nodiscard]] std::vector<std::int32_t> list(std::int32_t i) const {
    std::vector<std::int32_t> ids(lists_.ids(i), lists_.ids(i) + lists_.count(i));
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  FixedAxis axes_[2];
  Box box_;
  std::vector<double> radius_;
  double half_width_;
  std::mt19937_64 random_;
  NeighbourLists lists_;
  std::vector<NeighbourhoodCentre> centres_;
};

void expect_right_while_moving(Neighbourhoods& neighbourhoods, int moves, int checks) {
  ASSERT_NO_FATAL_FAILURE(neighbourhoods.expect_lists_of_all_pairs());
  for (int k = 1; k <= moves; ++k) {
    const std::int32_t i = neighbourhoods.any();
    const NeighbourhoodCentre to =
        neighbourhoods.unit() < 0.1 ? neighbourhoods.anywhere() : neighbourhoods.nearby(neighbourhoods.lists().centre(i));
    ASSERT_NO_FATAL_FAILURE(neighbourhoods.move(i, to)) << "move " << k;
    if (k % (moves / checks) == 0) {
      ASSERT_NO_FATAL_FAILURE(neighbourhoods.expect_lists_of_all_pairs()) << "move " << k;
    }
  }
}

Box shifted_box(double x, double y, Boundary in_x, Boundary in_y) { return {{-1.0, 2.0}, {x - 1.0, y + 2.0}, {in_x, in_y}}; }

const Boundary kinds[][2] = {{Boundary::periodic, Boundary::periodic},
                             {Boundary::walls, Boundary::walls},
                             {Boundary::periodic, Boundary::walls},
                             {Boundary::walls, Boundary::periodic}};

std::vector<double> equal(std::size_t count, double radius) { return std::vector<double>(count, radius); }

TEST(NeighbourLists, AreThoseOfAllPairsForEqualDisks) {
  for (const auto& kind : kinds)
    for (const double length : {4.0, 9.0, 30.0})
      for (const double half_width : {0.01, 0.2, 0.8}) {
        if (2.0 * half_width + 1.0 > length / 2.0) continue;  // nearest images would not be the only ones
        Neighbourhoods neighbourhoods(shifted_box(length, length, kind[0], kind[1]), equal(120, 0.5), half_width, 1);
        ASSERT_NO_FATAL_FAILURE(expect_right_while_moving(neighbourhoods, 2000, 10)) << length << " " << half_width;
      }
}

TEST(NeighbourLists, AreThoseOfAllPairsInThinBoxes) {
  for (const auto& kind : kinds) {
    Neighbourhoods flat(shifted_box(500.0, 2.6, kind[0], kind[1]), equal(150, 0.5), 0.1, 2);
    ASSERT_NO_FATAL_FAILURE(expect_right_while_moving(flat, 2000, 8));
    Neighbourhoods tall(shifted_box(3.0, 2000.0, kind[0], kind[1]), equal(150, 0.5), 0.2, 3);
    ASSERT_NO_FATAL_FAILURE(expect_right_while_moving(tall, 2000, 8));
  }
}

TEST(NeighbourLists, AreThoseOfAllPairsForRadiiAFactorOfAHundredApart) {
  for (const auto& kind : kinds) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<double> continuous, two;
    for (int i = 0; i < 150; ++i) {
      continuous.push_back(0.05 * std::pow(100.0, unit(random)));
      two.push_back(i % 30 == 7 ? 5.0 : 0.05);
    }
    Neighbourhoods many(shifted_box(40.0, 40.0, kind[0], kind[1]), continuous, 0.1, 5);
    ASSERT_NO_FATAL_FAILURE(expect_right_while_moving(many, 3000, 10));
    Neighbourhoods few(shifted_box(40.0, 30.0, kind[0], kind[1]), two, 0.03, 6);
    ASSERT_NO_FATAL_FAILURE(expect_right_while_moving(few, 3000, 10));
  }
}

TEST(NeighbourLists, GrowBeyondSixtyFourAndShrinkAgain) {
  for (const auto& kind : kinds) {
    Neighbourhoods neighbourhoods(shifted_box(30.0, 30.0, kind[0], kind[1]), equal(150, 0.5), 0.3, 7);
    for (int round = 0; round < 3; ++round) {
      std::uint32_t most = 0;
      for (std::int32_t i = 0; i < neighbourhoods.count(); ++i) {  // all into one corner, one by one
        ASSERT_NO_FATAL_FAILURE(
            neighbourhoods.move(i, neighbourhoods.at(0.01 * neighbourhoods.unit(), 0.01 * neighbourhoods.unit())));
        most = std::max(most, neighbourhoods.lists().count(0));
        if (i % 15 == 0) {
          ASSERT_NO_FATAL_FAILURE(neighbourhoods.expect_lists_of_all_pairs());
        }
      }
      EXPECT_EQ(most, 149u);
      for (std::int32_t i = 0; i < neighbourhoods.count(); ++i) {  // and out again
        ASSERT_NO_FATAL_FAILURE(neighbourhoods.move(i, neighbourhoods.anywhere()));
        if (i % 15 == 0) {
          ASSERT_NO_FATAL_FAILURE(neighbourhoods.expect_lists_of_all_pairs());
        }
      }
      EXPECT_LT(neighbourhoods.lists().count(0), 16u);
    }
  }
}

TEST(NeighbourLists, AreRightAfterEveryRebuild) {
  Neighbourhoods neighbourhoods(shifted_box(20.0, 20.0, Boundary::periodic, Boundary::walls), equal(200, 0.5), 0.1, 8);
  for (const double half_width : {0.5, 0.02, 1.5, 0.3}) {
    neighbourhoods.rebuild(half_width);
    EXPECT_EQ(neighbourhoods.lists().half_width(), half_width);
    ASSERT_NO_FATAL_FAILURE(expect_right_while_moving(neighbourhoods, 600, 4)) << half_width;
  }
}

TEST(NeighbourLists, OfNeighbourhoodsInOnePlaceNameEveryDisk) {
  Neighbourhoods neighbourhoods(shifted_box(30.0, 30.0, Boundary::periodic, Boundary::periodic), equal(40, 0.5), 0.2, 9);
  for (std::int32_t i = 0; i < 40; ++i) ASSERT_NO_FATAL_FAILURE(neighbourhoods.move(i, {INT32_MIN, INT32_MIN}));
  for (std::int32_t i = 0; i < 40; ++i) EXPECT_EQ(neighbourhoods.lists().count(i), 39u);
  ASSERT_NO_FATAL_FAILURE(neighbourhoods.expect_lists_of_all_pairs());
}

TEST(NeighbourLists, CountTheChangesOfOthersLists) {
  Neighbourhoods neighbourhoods(shifted_box(30.0, 30.0, Boundary::walls, Boundary::walls), equal(3, 0.5), 0.2, 10);
  neighbourhoods.move(0, neighbourhoods.at(0.1, 0.1));
  neighbourhoods.move(1, neighbourhoods.at(0.5, 0.5));
  neighbourhoods.move(2, neighbourhoods.at(0.9, 0.9));
  const std::uint64_t before = neighbourhoods.lists().changes();
  neighbourhoods.move(0, neighbourhoods.at(0.5, 0.51));
  EXPECT_EQ(neighbourhoods.lists().changes(), before + 1) << "disk 1 got disk 0";
  neighbourhoods.move(0, neighbourhoods.at(0.9, 0.91));
  EXPECT_EQ(neighbourhoods.lists().changes(), before + 3) << "and lost it to disk 2";
}

TEST(NeighbourLists, OfNoneOneAndTwoDisksAreWhatTheyShouldBe) {
  for (const auto& kind : kinds) {
    const Box box = shifted_box(10.0, 10.0, kind[0], kind[1]);
    Neighbourhoods none(box, {}, 0.1, 11);
    EXPECT_EQ(none.lists().entries(), 0u);
    Neighbourhoods one(box, equal(1, 0.5), 0.1, 12);
    ASSERT_NO_FATAL_FAILURE(expect_right_while_moving(one, 50, 10));
    Neighbourhoods two(box, {0.5, 0.25}, 0.1, 13);
    ASSERT_NO_FATAL_FAILURE(expect_right_while_moving(two, 500, 100));
  }
}

RC_GTEST_PROP(PropertyNeighbourLists, AreThoseOfAllPairsInAnyBoxForAnyRadii, ()) {
  const auto& kind = kinds[*rc::gen::inRange(0, 4)];
  const double x = *rc::gen::element(1.0, 3.0, 64.0), y = x * *rc::gen::element(0.05, 0.7, 1.0, 1.5);
  const int count = *rc::gen::element(1, 2, 5, 30, 100);
  const double largest = 0.2 * std::min(x, y) * *rc::gen::element(1.0, 0.3, 0.05);
  std::vector<double> radius;
  const double spread = *rc::gen::element(1.0, 1.5, 10.0, 1000.0);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < count; ++i) radius.push_back(largest * std::pow(spread, -unit(random)));
  // No wider than that nearest images are the only ones.
  const double half_width = (std::min(x, y) / 4.0 - largest) * *rc::gen::element(0.95, 0.3, 0.01);
  Neighbourhoods neighbourhoods(shifted_box(x, y, kind[0], kind[1]), radius, half_width, random());
  expect_right_while_moving(neighbourhoods, 200, 5);
  RC_ASSERT(!::testing::Test::HasFatalFailure());
}

}  // namespace
}  // namespace carom::test
