// The textbook engine against the all-pairs twin, event by event and bit by bit: cells, queue, plans and stale events
// must leave no trace.

#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "support/all_pairs.hpp"
#include "support/engines.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace carom::test {
namespace {

/// Compares so many events, or as many as the twin sees far enough for, and adds how many those were to `compared`.
template <class Rule>
void compare_events(const System& system, int events, int& compared) {
  const auto engine = make_engine("textbook", system, rule_only<Rule>);
  AllPairsTwin<Rule> twin(system.box, system.disks, system.state);
  engine->record_events(true);
  std::vector<Event> log;
  for (int k = 0; k < 20 * events && log.size() < static_cast<std::size_t>(events); ++k) {  // many events are cell crossings
    engine->run_until(forever, no_limit, 1);
    for (const Event& event : engine->take_events()) log.push_back(event);
  }
  const auto faults = engine->check_invariants();
  EXPECT_TRUE(faults.empty()) << faults.front();
  for (std::size_t k = 0; k < log.size(); ++k) {
    const Event expected = twin.step();
    if (expected.time == infinity<double>) return;  // too far for the twin
    const Event& event = log[k];
    ASSERT_EQ(event.time, expected.time) << "event " << k << " of disks " << event.disk << ", " << event.partner << " instead of "
                                         << expected.disk << ", " << expected.partner;
    ASSERT_EQ(event.time_remainder, expected.time_remainder) << "event " << k;
    ASSERT_EQ(event.disk, expected.disk) << "event " << k;
    ASSERT_EQ(event.partner, expected.partner) << "event " << k;
    ASSERT_EQ(event.velocity, expected.velocity) << "event " << k;
    ASSERT_EQ(event.partner_velocity, expected.partner_velocity) << "event " << k;
    ++compared;
  }
}

template <class Rule>
void expect_same_events(const System& system, int events) {
  int compared = 0;
  compare_events<Rule>(system, events, compared);
  EXPECT_EQ(compared, events);
}

Box thin_channel(double width) { return {{0.0, 0.0}, {30.0, width}, {Boundary::periodic, Boundary::walls}}; }

TEST(EnginesTextbookTwin, PeriodicGasHasTheSameEventsAsAllPairs) {
  for (const double packing_fraction : {0.05, 0.3, 0.6, 0.72}) {
    const System system = system_of(gas_scene(16, packing_fraction, Boundary::periodic));
    expect_same_events<Specular>(system, 400);
    expect_same_events<Reversal>(system, 400);
  }
}

TEST(EnginesTextbookTwin, WalledGasHasTheSameEventsAsAllPairs) {
  for (const double packing_fraction : {0.02, 0.3, 0.55}) {
    const System system = system_of(gas_scene(20, packing_fraction, Boundary::walls));
    expect_same_events<Specular>(system, 400);
    expect_same_events<Reversal>(system, 400);
  }
}

TEST(EnginesTextbookTwin, MixtureHasTheSameEventsAsAllPairs) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    const System system = system_of(mixture_scene(20, 0.5, boundary));
    expect_same_events<Specular>(system, 400);
    expect_same_events<Reversal>(system, 400);
  }
}

TEST(EnginesTextbookTwin, ThinChannelHasTheSameEventsAsAllPairs) {
  std::vector<Placed> placed;
  for (int i = 0; i < 12; ++i) placed.push_back({{0.7 + 2.5 * i, 0.6 + 0.05 * (i % 3)}, {std::sin(3.0 * i), std::cos(5.0 * i)}});
  expect_same_events<Specular>(system_of(thin_channel(1.5), placed), 1500);
}

TEST(EnginesTextbookTwin, DisksThatFillMostOfASmallPeriodicBoxMeetThroughSeveralImages) {
  // One cell per axis: each disk sees the other on every side.
  const System system = system_of(square_box(1.8, Boundary::periodic), {{{0.3, 0.4}, {1.0, 0.3}}, {{1.2, 1.3}, {-0.7, 0.9}}});
  expect_same_events<Specular>(system, 1000);
  expect_same_events<Reversal>(system, 1000);
}

TEST(EnginesTextbookTwin, EqualSpeedsOnASquareLatticeGiveTiesThatAreBrokenAlike) {
  // Everything meets at the same instants, over and over.
  std::vector<Placed> placed;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      placed.push_back({{2.0 * x + 1.0, 2.0 * y + 1.0}, {(x % 2 == 0) ? 1.0 : -1.0, (y % 2 == 0) ? 1.0 : -1.0}});
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    expect_same_events<Specular>(system_of(square_box(8.0, boundary), placed), 600);
    expect_same_events<Reversal>(system_of(square_box(8.0, boundary), placed), 600);
  }
}

TEST(EnginesTextbookTwin, ALightDiskSqueezedBetweenHeavyOnesKeepsItsDigits) {
  // Found by the property test below: mass ratio 4e6; the light ones become a hundred times faster than anything was, and
  // with the short clock of that time they overlapped by 1.5e-12 of a diameter.
  const Box box{{-3.0, 1.0}, {0.0, 6.9}, {Boundary::periodic, Boundary::walls}};
  const System system = system_of(box, {{{-2.725, 1.50390625}, {-2.0, -0.75}, 0.1, 0.25},
                                        {{-2.5916015625, 1.85078125}, {-1.25, -1.75}, 0.15, 1e6},
                                        {{-2.0359375, 2.37138671875}, {-0.75, -0.75}, 0.1, 1e6},
                                        {{-2.40234375, 2.28876953125}, {-0.75, -1.0}, 0.1, 0.25}});
  expect_same_events<Specular>(system, 400);
  expect_same_events<Reversal>(system, 400);
}

RC_GTEST_PROP(PropertyTextbookTwin, AnySmallSystemHasTheSameEventsAsAllPairs, ()) {
  const auto boundary = [] { return *rc::gen::element(Boundary::walls, Boundary::periodic); };
  const Box box = {
      {-3.0, 1.0}, {-3.0 + *rc::gen::inRange(30, 90) / 10.0, 1.0 + *rc::gen::inRange(30, 90) / 10.0}, {boundary(), boundary()}};
  const int wanted = *rc::gen::inRange(1, 14);
  std::vector<Placed> placed;
  for (int i = 0; i < wanted; ++i) {
    const double radius = *rc::gen::inRange(2, 13) / 10.0 / 2.0;
    const auto in = [&](int a) {
      return box.lower[a] + radius + (box.lengths()[a] - 2 * radius) * *rc::gen::inRange(0, 1025) / 1024.0;
    };
    const auto component = [] { return *rc::gen::inRange(-8, 9) / 4.0; };
    Placed disk{{in(0), in(1)}, {component(), component()}, radius, *rc::gen::element(0.25, 1.0, 3.0, 1e6)};
    for (int a = 0; a < 2; ++a)
      if (disk.r[a] >= box.upper[a]) disk.r[a] = box.lower[a];
    if (finds_room(box, placed, disk)) placed.push_back(disk);
  }
  int compared = 0;  // a disk alone, or disks that fly side by side, may have none
  compare_events<Specular>(system_of(box, placed), 200, compared);
  compare_events<Reversal>(system_of(box, placed), 200, compared);
  RC_ASSERT(!::testing::Test::HasFatalFailure());
}

}  // namespace
}  // namespace carom::test
