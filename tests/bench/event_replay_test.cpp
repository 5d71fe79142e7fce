// A recorded run once more: places, neighbours, domains, and the first difference of two runs.

#include "../../bench/event_replay.hpp"

#include "../../bench/diverging_runs.hpp"
#include "../../bench/shared_out.hpp"
#include "support/systems.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <random>
#include <vector>

namespace carom::test {
namespace {

using namespace bench;
using testing::UnorderedElementsAreArray;

struct Recorded {
  Box box;
  State start;
  std::vector<Event> events;
};

Recorded recorded_gas(std::int64_t disks, std::uint64_t collisions) {
  Simulation simulation = make_simulation(gas_scene(disks, 0.4, Boundary::periodic));
  Recorded run{simulation.scene().box, simulation.state(), {}};
  simulation.record_events(true);
  simulation.run_until(1e9, {.collisions = collisions});
  run.events = simulation.take_events();
  return run;
}

TEST(EventReplay, FindsEveryPairOfARunInContact) {
  const Recorded run = recorded_gas(256, 5000);
  EventReplay replay(run.box, run.start, 1.0, 2.0);
  for (const Event& event : run.events) ASSERT_TRUE(replay.collide(event)) << event.time;
}

TEST(EventReplay, SeesThatACollisionComesAMillionthLate) {
  const Recorded run = recorded_gas(256, 1);
  EventReplay replay(run.box, run.start, 1.0, 2.0);
  Event late = run.events.front();
  late.time += 1e-6;
  EXPECT_FALSE(replay.collide(late));
}

TEST(EventReplay, NeighboursAreThoseOfASearchOfAllPairs) {
  const Recorded run = recorded_gas(256, 1000);
  EventReplay replay(run.box, run.start, 1.0, 3.0);
  std::vector<Id> found;
  for (const Event& event : run.events) {
    ASSERT_TRUE(replay.collide(event));
    for (const double distance : {1.5, 3.0}) {
      std::vector<Id> expected;
      for (Id k = 0; k < 256; ++k)
        for (const Id end : {event.disk, event.partner}) {
          Eigen::Vector2d r = replay.place(k, event.time) - replay.place(end, event.time);
          for (int a = 0; a < 2; ++a) r[a] = std::remainder(r[a], run.box.lengths()[a]);
          if (r.norm() > distance) continue;
          expected.push_back(k);
          break;
        }
      replay.near(event.disk, event.partner, event.time, distance, found);
      ASSERT_THAT(found, UnorderedElementsAreArray(expected)) << event.time;
    }
  }
}

TEST(EventReplay, BoxTooSmallForItsCellsIsRefused) {
  const Recorded run = recorded_gas(16, 1);
  EXPECT_THROW(EventReplay(run.box, run.start, 1.0, 3.0), std::invalid_argument);
}

const Domains six{{{-1.0, 0.0}, {2.0, 2.0}, {Boundary::periodic, Boundary::periodic}}, 3, 2};

TEST(EventReplay, DomainsAreCountedAlongXFirstAndRepeatWithTheBox) {
  EXPECT_EQ(six.home({-0.5, 0.5}), 0);
  EXPECT_EQ(six.home({1.5, 0.5}), 2);
  EXPECT_EQ(six.home({-0.5, 1.5}), 3);
  EXPECT_EQ(six.home({-0.5 + 3.0, 1.5 - 4.0}), 3);
}

TEST(EventReplay, DomainsNearAPlaceAreThoseOfThePlacesRoundIt) {
  std::mt19937 random(1);
  const auto coordinate = [&] { return 1e-3 * static_cast<double>(random() % 9000) - 4.0; };
  constexpr double distance = 0.3005;  // from no coordinate to a border: no ties
  for (int n = 0; n < 500; ++n) {
    const Eigen::Vector2d r(coordinate(), coordinate());
    // Domains are wider than the square round r, so its corners reach all that it meets.
    DomainSet expected = 0;
    for (const double x : {-distance, 0.0, distance})
      for (const double y : {-distance, 0.0, distance}) expected |= only(six.home(r + Eigen::Vector2d(x, y)));
    ASSERT_EQ(six.within(r, distance), expected) << r;
  }
}

TEST(EventReplay, PairsPartedByABorderAreThoseOfAllDirections) {
  // Buffon's needle: the share of needles of length 1 at any place and angle that cross a line of a square grid of side 10.
  std::mt19937 random(1);
  const Domains domains{{{0.0, 0.0}, {20.0, 20.0}, {Boundary::periodic, Boundary::periodic}}, 2, 2};
  const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) * 0x1p-32; };
  constexpr int needles = 100'000;
  int parted = 0;
  for (int n = 0; n < needles; ++n) {
    const Eigen::Vector2d r(20.0 * uniform(), 20.0 * uniform());
    const double angle = 2.0 * std::numbers::pi * uniform();
    parted += domains.home(r) != domains.home(r + Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  State nothing;
  nothing.positions = nothing.velocities = Eigen::Matrix2Xd::Zero(2, 1);
  const EventReplay replay(domains.box, nothing, 1.0, 2.0);
  const double theory = SharedOut(domains, replay, 1).parted_in_theory(1.0);
  // Five standard errors of a count.
  EXPECT_NEAR(parted, needles * theory, 5.0 * std::sqrt(needles * theory));
}

Event met(double time, Id disk, Id partner) {
  return {time, 0.0, disk, partner, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
}

TEST(EventReplay, FirstDifferenceIsTheEarliestOfAWatchedDisk) {
  const std::vector<Event> one = {met(1.0, 0, 1), met(2.0, 2, 3), met(3.0, 1, 2), met(4.0, 0, 1)};
  const std::vector<Event> other = {met(1.0, 0, 1), met(1.5, 2, 3), met(3.1, 1, 2), met(4.0, 0, 1)};
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(first_difference(one, one, {true, true, true, true}, 1e-9), infinity);
  EXPECT_EQ(first_difference(one, other, {true, true, true, true}, 1e-9), 1.5);
  EXPECT_EQ(first_difference(one, other, {true, true, false, false}, 1e-9), 3.0);
  EXPECT_EQ(first_difference(one, other, {true, false, false, false}, 1e-9), infinity);
  EXPECT_EQ(first_difference(one, other, {true, true, false, false}, 0.2), infinity);
}

TEST(EventReplay, FirstDifferenceSeesAnotherPartnerAndAMissedCollision) {
  const std::vector<Event> one = {met(1.0, 0, 1), met(2.0, 0, 1)};
  EXPECT_EQ(first_difference(one, std::vector<Event>{met(1.0, 0, 2)}, {true, false, false}, 1e-9), 1.0);
  EXPECT_EQ(first_difference(one, std::vector<Event>{met(1.0, 0, 1)}, {true, false, false}, 1e-9), 2.0);
}

}  // namespace
}  // namespace carom::test
