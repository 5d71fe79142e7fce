// Where an engine that keeps lines, neighbourhoods and stale ids could go wrong: many events at one instant, disks that become
// faster than anything was, pairs that see each other round the box, and very few disks.

#include "support/engines.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

/// Enough to put a drawn system into a test of its own.
std::string described(const System& system, CollisionRule rule) {
  std::string text =
      fmt::format("{} in a box of {} x {}, {} along x, {} along y", rule == CollisionRule::specular ? "specular" : "reversal",
                  system.box.lengths()[0], system.box.lengths()[1], system.box.periodic(0) ? "periodic" : "walls",
                  system.box.periodic(1) ? "periodic" : "walls");
  for (Eigen::Index i = 0; i < system.state.positions.cols(); ++i) {
    const Eigen::Vector2d r = system.state.positions.col(i), v = system.state.velocities.col(i);
    text += fmt::format("\n  {{{{{}, {}}}, {{{}, {}}}, {}, {}}},", r[0], r[1], v[0], v[1],
                        system.disks.radius[static_cast<std::size_t>(i)], system.disks.mass[static_cast<std::size_t>(i)]);
  }
  return text;
}

/// For systems whose numbers are all dyadic: the very same events, ties in the same order.
::testing::AssertionResult same_events_exactly(const System& system, CollisionRule rule, std::size_t most, double until) {
  const auto textbook = make_engine("textbook", system, rule);
  const auto fast = make_engine("fast", system, rule);
  const std::vector<Event> expected = next_events(*textbook, most, {until, 0.0}, 100);
  const std::vector<Event> found = next_events(*fast, most, {until, 0.0}, 100);
  for (std::size_t k = 0; k < std::min(expected.size(), found.size()); ++k) {
    const Event &a = found[k], &b = expected[k];
    if (a.disk != b.disk || a.partner != b.partner || a.time != b.time || a.velocity != b.velocity ||
        a.partner_velocity != b.partner_velocity)
      return ::testing::AssertionFailure() << "event " << k << ": " << a.disk << ", " << a.partner << " at " << a.time
                                           << " with velocity " << a.velocity.transpose() << " instead of " << b.disk << ", "
                                           << b.partner << " at " << b.time << " with velocity " << b.velocity.transpose();
  }
  if (found.size() != expected.size())
    return ::testing::AssertionFailure() << found.size() << " events instead of " << expected.size();
  const auto faults = fast->check_invariants();
  if (!faults.empty()) return ::testing::AssertionFailure() << faults.front();
  return ::testing::AssertionSuccess();
}

TEST(EngineTies, EqualSpeedsOnASquareLatticeAreBrokenAsInTheTextbook) {
  for (const int side : {4, 8, 16}) {
    std::vector<Placed> placed;
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        placed.push_back({{2.0 * x + 1.0, 2.0 * y + 1.0}, {(x % 2 == 0) ? 1.0 : -1.0, (y % 2 == 0) ? 1.0 : -1.0}});
    for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
      for (const CollisionRule rule : both_rules)
        EXPECT_TRUE(same_events_exactly(system_of(square_box(2.0 * side, boundary), placed), rule, 6000, 64.0)) << side;
  }
}

/// Disks on points of a lattice of spacing 1 (diameter 1: they may touch), in rows 2 apart, that move along their rows or
/// rest: all times are multiples of 1/4, and most events happen at the instant of another.
System draw_rows() {
  const int length = *rc::gen::element(8, 16, 32);
  const int rows = *rc::gen::inRange(2, 9);
  const auto boundary = rc::gen::element(Boundary::walls, Boundary::periodic);
  const Box box{{0.0, 0.0}, {length, 2.0 * rows}, {*boundary, *boundary}};
  std::vector<Placed> placed;
  const int crowd = *rc::gen::element(2, 4, 8);
  for (int column = 0; column < length; ++column)
    for (int row = 0; row < rows; ++row)
      if (*rc::gen::inRange(0, crowd) == 0)
        placed.push_back({{column + 0.5, 2.0 * row + 1.0}, {*rc::gen::element(-1.0, 0.0, 1.0), 0.0}});
  if (placed.empty()) placed.push_back({{0.5, 1.0}, {1.0, 0.0}});
  // Ids in any order: they decide ties.
  for (std::size_t i = placed.size(); i > 1; --i) std::swap(placed[i - 1], placed[*rc::gen::inRange<std::size_t>(0, i)]);
  return system_of(box, placed);
}

RC_GTEST_PROP(PropertyEngineTies, RowsOfDisksThatMeetAtTheSameInstantsAreBrokenAsInTheTextbook, ()) {
  const System system = draw_rows();
  const CollisionRule rule = *rc::gen::element(CollisionRule::specular, CollisionRule::reversal);
  const auto result = same_events_exactly(system, rule, 2000, 100.0);
  if (!result) RC_FAIL(fmt::format("{}: {}", result.message(), described(system, rule)));
}

TEST(EngineTies, ADiskThatMeetsAWallAndALowerDiskAtOnceMeetsTheDiskFirst) {
  // Disk 2 sets disk 1 moving upwards at t = 1. At t = 4 it touches the top wall and disk 0, which was predicted without it. From
  // r =
  // (-4, 3) at t = 1 no rounding comes in: the distance is 5.
  const System system = system_of({{0.0, 0.0}, {16.0, 8.0}, {Boundary::walls, Boundary::walls}},
                                  {{{5.0, 7.5}, {1.0, 0.0}}, {{10.0, 4.5}, {0.0, 0.0}}, {{10.0, 2.5}, {0.0, 1.0}}});
  for (const CollisionRule rule : both_rules) {
    const auto engine = make_engine("fast", system, rule);
    const std::vector<Event> events = next_events(*engine, 2);
    EXPECT_EQ(events[1].time, 4.0);
    EXPECT_EQ(events[1].disk, 0);
    EXPECT_EQ(events[1].partner, 1);
    EXPECT_TRUE(same_events_exactly(system, rule, 100, 4.5));
  }
}

TEST(EngineTies, ACradleHandsOnItsVelocityAtOneInstant) {
  for (int row = 2; row <= 14; ++row) {
    std::vector<Placed> placed = {{{2.0, 2.0}, {1.0, 0.0}}};
    for (int i = 1; i < row; ++i) placed.push_back({{4.0 + i, 2.0}, {0.0, 0.0}});  // touching, at rest
    for (const bool turned : {false, true}) {
      if (turned) std::reverse(placed.begin(), placed.end());
      const System system = system_of({{0.0, 0.0}, {32.0, 4.0}, {Boundary::walls, Boundary::walls}}, placed);
      for (const CollisionRule rule : both_rules) {
        EXPECT_TRUE(same_events_exactly(system, rule, 200, 200.0)) << row;
        const auto engine = make_engine("fast", system, rule);
        run_to(*engine, 3.0);
        for (int i = 0; i < row; ++i)
          EXPECT_EQ(engine->state().velocities(0, turned ? row - 1 - i : i), i == row - 1 ? 1.0 : 0.0);
      }
    }
  }
}

// ------------------------------------------------------------------------------------------------------ sudden speed

/// Runs event by event and compares the plan with an exhaustive search after each.
void expect_sound(const System& system, CollisionRule rule, int events) {
  const auto engine = make_engine("fast", system, rule);
  for (int k = 0; k < events; ++k) {
    engine->run_until(forever, no_limit, 1);
    const auto faults = engine->check_invariants();
    ASSERT_TRUE(faults.empty()) << faults.front() << ", after " << k + 1 << " events, at t = " << engine->now().high << ": "
                                << described(system, rule);
  }
}

TEST(EngineSuddenSpeed, ALightDiskSqueezedBetweenHeavyOnesIsNeverLost) {
  for (const double ratio : {1e2, 1e6, 1e12})
    for (const double aspect : {1.0, 8.0})
      for (const Boundary boundary : {Boundary::periodic, Boundary::walls}) {
        const Box box{{0.0, 0.0}, {12.0 * aspect, 12.0}, {boundary, boundary}};
        const System system = system_of(box, {{{2.0, 6.0}, {1.0, 0.0}, 0.5, ratio},
                                              {{5.0, 6.125}, {0.125, 0.0}, 0.25, 1.0},
                                              {{9.0, 6.0}, {-1.0, 0.0}, 0.5, ratio},
                                              {{7.0, 2.0}, {0.0, 0.5}, 0.5, 1.0}});
        for (const CollisionRule rule : both_rules) expect_sound(system, rule, 400);
      }
}

TEST(EngineSuddenSpeed, AnEpochThatBeginsInTheMiddleOfARunDoesNotShiftItsEnd) {
  const System system = system_of(
      {{0.0, 0.0}, {12.0, 8.0}, {Boundary::walls, Boundary::walls}},
      {{{2.0, 4.0}, {1.0, 0.0}, 0.5, 1e6}, {{5.0, 4.125}, {0.125, 0.0}, 0.25, 1.0}, {{9.0, 4.0}, {-1.0, 0.0}, 0.5, 1e6}});
  for (int k = 1; k <= 200; ++k) {
    const double end = 0.04 * k;
    const auto straight = make_engine("fast", system);
    const auto stepping = make_engine("fast", system);
    run_to(*straight, end);
    while (!stepping->run_until(Instant{end, 0.0}, no_limit, 1)) continue;
    ASSERT_NEAR(straight->now().high, end, 1e-15 * end);
    ASSERT_EQ(straight->totals().pair, stepping->totals().pair) << end;
    ASSERT_EQ(straight->state().velocities, stepping->state().velocities) << end;
  }
}

/// A light disk between two heavy ones that close in on it, in a box of the given length, periodic and 6 wide.
System squeezed(double length, double left, double light, double speed, double right) {
  const Box box{{0.0, 0.0}, {length, 6.0}, {Boundary::periodic, Boundary::periodic}};
  return system_of(
      box, {{{left, 3.0}, {1.0, 0.0}, 0.5, 1e6}, {{light, 3.0}, {speed, 0.0}, 0.25, 1.0}, {{right, 3.0}, {-1.0, 0.0}, 0.5, 1e6}});
}

TEST(EngineSuddenSpeed, ADiskThatOutrunsItsEpochKeepsItsPlace) {
  for (const System& system : {squeezed(154.0, 3.5, 26.0, 0.0, 31.0), squeezed(145.0, 2.5, 12.25, 0.272, 36.85),
                               squeezed(48.35, 3.95, 7.0, 0.072, 28.77), squeezed(170.8, 2.7, 30.2, 0.278, 36.25)}) {
    for (const CollisionRule rule : both_rules) {
      expect_sound(system, rule, 400);
      const auto fast = make_engine("fast", system, rule);
      const auto textbook = make_engine("textbook", system, rule);
      const auto found = next_events(*fast, 5), expected = next_events(*textbook, 5);
      for (std::size_t n = 0; n < 5; ++n) {  // on one line: no chaos
        EXPECT_EQ(found[n].disk, expected[n].disk) << n;
        EXPECT_EQ(found[n].partner, expected[n].partner) << n;
        EXPECT_NEAR(found[n].time, expected[n].time, 1e-12 * expected[n].time) << n;
      }
    }
  }
}

TEST(EngineSuddenSpeed, ADiskThatOutrunsItsEpochMissesNoCollision) {
  const Box box{{-3.0, 1.0}, {3.0, 7.0}, {Boundary::walls, Boundary::periodic}};
  const System system = system_of(box, {{{-1.2970703125, 3.854150390625}, {-1.5, -0.5}, 0.1, 1e9},
                                        {{-0.837890625, 2.576171875}, {-0.5, -0.5}, 1.0, 1e-3},
                                        {{-1.86376953125, 3.60791015625}, {0.0, -0.5}, 0.25, 1e9}});
  expect_sound(system, CollisionRule::specular, 400);
}

RC_GTEST_PROP(PropertyEngineSuddenSpeed, ThePlanIsSoundAfterEveryEventWhateverTheMasses, ()) {
  const auto boundary = rc::gen::element(Boundary::walls, Boundary::periodic, Boundary::periodic);
  const Box box = {{-3.0, 1.0},
                   {-3.0 + *rc::gen::element(6.0, 12.0, 64.0, 200.0), 1.0 + *rc::gen::element(6.0, 12.0)},
                   {*boundary, *boundary}};
  std::vector<Placed> placed;
  const int wanted = *rc::gen::inRange(2, 14);
  for (int i = 0; i < wanted; ++i) {
    const double radius = *rc::gen::element(0.1, 0.25, 0.5, 1.0);
    const auto in = [&](int a) {
      return box.lower[a] + radius + (box.lengths()[a] - 2 * radius) * *rc::gen::inRange(0, 4097) / 4096.0;
    };
    const auto component = [] { return *rc::gen::inRange(-8, 9) / 4.0; };
    const Placed disk{{in(0), in(1)}, {component(), component()}, radius, *rc::gen::element(1e-3, 1.0, 3.0, 1e6, 1e9)};
    if (finds_room(box, placed, disk)) placed.push_back(disk);
  }
  const CollisionRule rule = *rc::gen::element(CollisionRule::specular, CollisionRule::reversal);
  expect_sound(system_of(box, placed), rule, 300);
  RC_ASSERT(!::testing::Test::HasFatalFailure());
}

}  // namespace
}  // namespace carom::test
