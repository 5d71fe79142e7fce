// The measurements of docs/parallel.md on lists of events so short that the answer is known, and against exhaustive twins.

#include "../../bench/event_graph.hpp"

#include <gmock/gmock.h>

#include <random>
#include <set>
#include <vector>

namespace carom::test {
namespace {

using namespace bench;

struct Collision {
  Id i, j;
  std::vector<Id> zone;
};

Collision pair(Id i, Id j) { return {i, j, {i, j}}; }

/// Disks on a ring that collide with the next one, in any order; the zone reaches one disk further to both sides.
std::vector<Collision> ring(Id disks, int events, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Collision> collisions;
  for (int e = 0; e < events; ++e) {
    const Id i = static_cast<Id>(random() % static_cast<unsigned>(disks));
    const auto at = [&](Id step) { return (i + step + disks) % disks; };
    collisions.push_back({i, at(1), {at(-1), i, at(1), at(2)}});
  }
  return collisions;
}

/// Whether `later` needs `earlier` directly, by the definition: the one moved a disk in the zone of the other.
bool needs(const Collision& later, const Collision& earlier) {
  const std::set<Id> zone(later.zone.begin(), later.zone.end());
  return zone.contains(earlier.i) || zone.contains(earlier.j);
}

CriticalPath path_of(std::size_t disks, const std::vector<Collision>& collisions) {
  CriticalPath path(disks);
  for (const auto& [i, j, zone] : collisions) path.add(i, j, zone);
  return path;
}

TEST(EventGraph, PathThroughAHandoverIsAsLongAsTheHandover) {
  // 0-1, 1-2, 2-3 one after the other; 4-5 beside them.
  const CriticalPath path = path_of(6, {pair(0, 1), pair(4, 5), pair(1, 2), pair(2, 3)});
  EXPECT_EQ(path.length(), 3);
}

TEST(EventGraph, PathOfEventsApartIsOne) { EXPECT_EQ(path_of(6, {pair(0, 1), pair(2, 3), pair(4, 5)}).length(), 1); }

TEST(EventGraph, ADomainThatOnlyReadsWaitsAndIsNotWaitedFor) {
  // 2-3 reads 1, which 0-1 has moved; 0-1 again reads no other disk.
  EXPECT_EQ(path_of(4, {pair(0, 1), {2, 3, {1, 2, 3}}, pair(0, 1)}).length(), 2);
}

TEST(EventGraph, CriticalPathIsThatOfAnExhaustiveSearch) {
  const auto collisions = ring(12, 200, 1);
  std::vector<std::int64_t> depth(collisions.size(), 1);
  std::int64_t longest = 0;
  for (std::size_t e = 0; e < collisions.size(); ++e) {
    for (std::size_t f = 0; f < e; ++f)
      if (needs(collisions[e], collisions[f])) depth[e] = std::max(depth[e], depth[f] + 1);
    longest = std::max(longest, depth[e]);
  }
  EXPECT_EQ(path_of(12, collisions).length(), longest);
}

TEST(EventGraph, IndependentEventsOfAWindowAreThoseOfAnExhaustiveSearch) {
  constexpr std::size_t size = 7;
  const auto collisions = ring(20, 205, 2);  // 29 windows and a rest that is not counted
  Windows windows(20, size);
  for (const auto& [i, j, zone] : collisions) windows.add(i, j, zone);
  std::int64_t independent = 0;
  for (std::size_t e = 0; e < 29 * size; ++e) {
    bool free = true;
    for (std::size_t f = e - e % size; f < e; ++f) free = free && !needs(collisions[e], collisions[f]);
    independent += free;
  }
  EXPECT_EQ(windows.complete(), 29);
  EXPECT_EQ(windows.independent(), independent);
}

TEST(EventGraph, CoresThatNeverMeetShareTheWorkAndOnesThatAlwaysMeetDoNot) {
  DomainClocks apart(2, 4.0), together(2, 4.0);
  for (int k = 0; k < 10; ++k) {
    apart.add(only(static_cast<Id>(k % 2)));
    together.add(only(0) | only(1));
  }
  EXPECT_EQ(apart.speed_up(), 2.0);
  EXPECT_EQ(apart.meetings(), 0);
  EXPECT_EQ(together.speed_up(), 0.2);  // each event takes 1 + 4
  EXPECT_EQ(together.meetings(), 10);
}

TEST(EventGraph, TheDomainAheadWaitsForTheOneItCollidesWith) {
  DomainClocks clocks(2, 0.0);
  for (int k = 0; k < 5; ++k) clocks.add(only(0));
  clocks.add(only(0) | only(1));  // begins at 5, ends at 6
  clocks.add(only(1));            // ends at 7
  EXPECT_EQ(clocks.speed_up(), 1.0);
}

TEST(EventGraph, RollbackTakesWhatFollowsFromACollisionAcrossTheBorder) {
  // Disks 0 to 2 at home in domain 0, 3 to 5 in domain 1.
  Rollback rollback(2, {0, 0, 0, 1, 1, 1});
  const auto add = [&](const Collision& c) { rollback.add(c.i, c.j, c.zone); };
  add(pair(0, 1));         // nothing has crossed yet
  add({4, 5, {3, 4, 5}});  // nor here
  add(pair(2, 3));         // across: all three
  add(pair(1, 2));         // follows from it
  add({0, 1, {0, 1, 2}});  // from that
  add(pair(4, 5));         // only its domain is late
  add({4, 5, {3, 4, 5}});  // 3 is in its zone
  EXPECT_EQ(rollback.events, 7);
  EXPECT_EQ(rollback.cross, 3);
  EXPECT_EQ(rollback.near, 4);
  EXPECT_EQ(rollback.whole, 5);
}

TEST(EventGraph, LookAcrossTheBorderIsNoCollisionAcrossIt) {
  Rollback rollback(2, {0, 0, 1, 1});
  rollback.add(0, 1, std::vector<Id>{0, 1, 2});
  EXPECT_EQ(rollback.cross, 0);
  EXPECT_EQ(rollback.near, 1);
  EXPECT_EQ(rollback.whole, 0);
}

TEST(EventGraph, NewWindowOfARollbackForgetsTheOldOne) {
  Rollback rollback(2, {0, 0, 1, 1});
  rollback.add(1, 2, std::vector<Id>{1, 2});
  rollback.begin({0, 0, 1, 1});
  rollback.add(0, 1, std::vector<Id>{0, 1});
  EXPECT_EQ(rollback.cross, 1);
  EXPECT_EQ(rollback.near, 1);
  EXPECT_EQ(rollback.whole, 1);
}

/// Six disks in a row, the first three at home in domain 0; each domain has a copy of one disk of the other.
void begin_row(HaloWindows& windows) {
  const DomainSet left = only(0), right = only(1), both = left | right;
  windows.begin({0, 0, 0, 1, 1, 1}, {left, left, both, both, right, right});
}

TEST(EventGraph, WindowEndsWhenWhatIsBeyondTheHaloComesHome) {
  HaloWindows windows;
  begin_row(windows);
  EXPECT_TRUE(windows.add(2, 3));   // both copies have both
  EXPECT_TRUE(windows.add(4, 5));   // beyond the halo of domain 0
  EXPECT_TRUE(windows.add(3, 4));   // so 3 is wrong in the copy of domain 0, where it is not at home
  EXPECT_FALSE(windows.add(2, 3));  // and would now make 2 wrong, which is
  EXPECT_EQ(windows.events(), 3);
  begin_row(windows);
  EXPECT_TRUE(windows.add(2, 3));
  EXPECT_EQ(windows.windows(), 1);
}

TEST(EventGraph, HaloIsWorkedOnTwice) {
  HaloWindows windows;
  begin_row(windows);
  EXPECT_EQ(windows.copied(), 2);
  EXPECT_TRUE(windows.add(0, 1));  // domain 0 alone
  EXPECT_TRUE(windows.add(2, 3));  // both
  EXPECT_TRUE(windows.add(1, 2));  // domain 0, and domain 1, which has a copy of 2
  EXPECT_EQ(windows.busiest(), 3);
  begin_row(windows);
  EXPECT_TRUE(windows.add(4, 5));  // domain 1 alone
  EXPECT_EQ(windows.busiest(), 4);
}

}  // namespace
}  // namespace carom::test
