// One plan per disk, and the order of events at one time.

#include "engine/plans.hpp"

#include "core/real.hpp"

#include <carom/state.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace carom::test {
namespace {

TEST(Plans, TheEarlierOfTwoEventsIsTheNextAndTheEdgeWinsATie) {
  for (const double pair : {1.0, 2.0, infinity<double>})
    for (const double edge : {1.0, 2.0, infinity<double>}) {
      const Plan plan{pair, edge, 7, wall_top, 1, 1};
      EXPECT_EQ(plan.edge_first(), edge <= pair);
      EXPECT_EQ(plan.time(), edge <= pair ? edge : pair);
      EXPECT_EQ(plan.other(), edge <= pair ? std::int32_t{wall_top} : 7);
    }
}

TEST(Plans, AWallTakesThePlaceOfALaterEventAndOfLeavingTheNeighbourhoodAtItsTime) {
  Plan plan{infinity<double>, 2.0, -1, neighbourhood_edge, 1, 1};
  plan.consider_edge(3.0, wall_left);
  EXPECT_EQ(plan.edge, neighbourhood_edge);
  plan.consider_edge(2.0, wall_left);
  EXPECT_EQ(plan.edge, wall_left);
  plan.consider_edge(2.0, wall_top);
  EXPECT_EQ(plan.edge, wall_left);
  plan.consider_edge(1.5, wall_top);
  EXPECT_EQ(plan.edge, wall_top);
  EXPECT_EQ(plan.edge_time, 1.5);
}

TEST(Plans, APlanIsStaleOnceThePartnerHasCollidedAndStaysSoInANewEpoch) {
  const LargeVector<std::int32_t> ids{0, 1, 2};
  Plans plans(3, ids);
  plans[0] = {5.0, 9.0, 1, neighbourhood_edge, 4, 4};
  plans[1] = {6.0, 3.0, 2, neighbourhood_edge, 3, 3};
  plans[2] = {infinity<double>, 7.0, -1, neighbourhood_edge, 5, 5};
  EXPECT_FALSE(plans.is_stale(plans[0]));
  EXPECT_TRUE(plans.is_stale(plans[1]));
  plans.rebase(4.0);
  EXPECT_EQ(plans[0].pair_time, 1.0);
  EXPECT_EQ(plans[0].edge_time, 5.0);
  EXPECT_EQ(plans[1].edge_time, 0.0);  // never before the zero of time
  EXPECT_EQ(plans[2].pair_time, infinity<double>);
  EXPECT_FALSE(plans.is_stale(plans[0]));
  EXPECT_TRUE(plans.is_stale(plans[1]));
  plans[1].last_collided = 2;
  EXPECT_TRUE(plans.is_stale(plans[0]));
}

TEST(Plans, AnEarlierCollisionPrecedesThePlannedOneAndAtOneTimeThatWithTheLowerId) {
  const LargeVector<std::int32_t> ids{2, 0, 3, 1};
  Plans plans(4, ids);
  plans[0] = {5.0, 9.0, 3, neighbourhood_edge, 1, 1};
  EXPECT_TRUE(plans.precedes_planned(0, 4.9, 2));
  EXPECT_FALSE(plans.precedes_planned(0, 5.1, 1));
  EXPECT_TRUE(plans.precedes_planned(0, 5.0, 1));   // id 0 before id 1
  EXPECT_FALSE(plans.precedes_planned(0, 5.0, 2));  // id 3 after id 1
  EXPECT_FALSE(plans.precedes_planned(0, infinity<double>, -1));
  plans[0] = {infinity<double>, 9.0, -1, neighbourhood_edge, 1, 1};
  EXPECT_FALSE(plans.precedes_planned(0, infinity<double>, -1));
}

TEST(Plans, AWallAtTheTimeOfAPartnerWithALowerIdWaits) {
  const LargeVector<std::int32_t> ids{1, 0, 2};
  Plans plans(3, ids);
  const auto edge_time = [&](double edge, std::int32_t partner, std::int32_t what) {
    plans[0] = {5.0, edge, partner, what, 1, 1};
    plans.resolve_wall_pair_tie(0);
    EXPECT_EQ(plans[0].pair_time, 5.0);
    return plans[0].edge_time;
  };
  EXPECT_EQ(edge_time(5.0, 1, wall_left), infinity<double>);
  EXPECT_EQ(edge_time(5.0, 2, wall_left), 5.0);
  EXPECT_EQ(edge_time(4.0, 1, wall_left), 4.0);
  EXPECT_EQ(edge_time(5.0, 1, neighbourhood_edge), 5.0);
}

/// The rule of ties, with ids in place of slots, as a tuple that sorts by itself.
std::tuple<int, std::int32_t, std::int32_t, std::int32_t> key(const FutureEvent& event, const LargeVector<std::int32_t>& ids) {
  const auto id = [&](std::int32_t slot) { return ids[static_cast<std::size_t>(slot)]; };
  const std::int32_t mine = id(event.disk);
  if (event.other == neighbourhood_edge) return {0, mine, 0, mine};
  if (event.other < 0) return {1, mine, event.other, mine};
  return {1, std::min(mine, id(event.other)), std::max(mine, id(event.other)), mine};
}

TEST(Plans, EventsAtOneTimeAreOrderedByIdsWhateverTheSlots) {
  const LargeVector<std::int32_t> ids{2, 0, 3, 1};
  const Plans plans(4, ids);
  std::vector<FutureEvent> events;
  for (std::int32_t disk = 0; disk < 4; ++disk)
    for (const std::int32_t other : {std::int32_t{neighbourhood_edge}, std::int32_t{wall_left}, std::int32_t{wall_top},
                                     std::int32_t{first_obstacle}, 0, 1, 2, 3})
      if (other != disk) events.push_back({1.0, disk, other});
  for (const FutureEvent& a : events)
    for (const FutureEvent& b : events) EXPECT_EQ(plans.precedes(a, b), key(a, ids) < key(b, ids));
}

}  // namespace
}  // namespace carom::test
