// Events as an engine writes them down.

#include "engine/collision_recorder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace carom::test {
namespace {

using V = Vec2<double>;

const LargeVector<std::int32_t> reversed_ids{3, 2, 1, 0};

std::vector<Event> taken_from(CollisionRecorder& recorder) {
  std::vector<Event> events;
  recorder.take_events(events);
  return events;
}

/// Collision k of slots k % 4 and (k + 1) % 4 at time k, with velocities made of k.
void record(CollisionRecorder& recorder, int k) { recorder.record(k, k % 4, (k + 1) % 4, V(k, 1), V(k, 2), V(k, 3), V(k, 4)); }

TEST(CollisionRecorder, TheLogHasIdsTheLowerFirstAndTimesFromTheEpoch) {
  CollisionRecorder recorder(reversed_ids, V(0, 0));
  EXPECT_FALSE(recorder.active());
  recorder.log_events(true);
  EXPECT_TRUE(recorder.active());
  recorder.begin_epoch({100.0, 0.0});
  recorder.record(0.25, 0, 2, V(1, 2), V(3, 4), V(5, 6), V(7, 8));
  recorder.log_hit(0.5, 1, wall_top, V(9, 10));
  const std::vector<Event> events = taken_from(recorder);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].time, 100.25);
  EXPECT_EQ(events[0].disk, 1);
  EXPECT_EQ(events[0].partner, 3);
  EXPECT_EQ(events[0].velocity, Eigen::Vector2d(7, 8));
  EXPECT_EQ(events[0].partner_velocity, Eigen::Vector2d(5, 6));
  EXPECT_EQ(events[1].time, 100.5);
  EXPECT_EQ(events[1].disk, 2);
  EXPECT_EQ(events[1].partner, wall_top);
  EXPECT_EQ(events[1].velocity, Eigen::Vector2d(9, 10));
  EXPECT_TRUE(taken_from(recorder).empty());
}

TEST(CollisionRecorder, VelocitiesInTheLogAreThoseOfDisksThatFall) {
  CollisionRecorder recorder(reversed_ids, V(0, -2));
  recorder.log_events(true);
  recorder.record(3.0, 3, 0, V(0, 0), V(0, 0), V(1, 1), V(0, 5));
  const std::vector<Event> events = taken_from(recorder);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].velocity, Eigen::Vector2d(1, -5));
  EXPECT_EQ(events[0].partner_velocity, Eigen::Vector2d(0, -1));
}

TEST(CollisionRecorder, AListenerHearsEveryCollisionOnceInOrderAndWithItsEpochWhateverItsRoom) {
  for (const std::size_t room : {0u, 1u, 7u, 1000u}) {
    CollisionRecorder recorder(reversed_ids, V(0, 0));
    std::vector<CollisionRecord> memory(room + 40);  // the recorder touches what lies ahead
    int heard = 0;
    CollisionListener listener;
    listener.on_collisions = [&](const Instant& epoch, std::span<const CollisionRecord> records) {
      EXPECT_LE(records.size(), room == 0 ? 64u : room);
      for (const CollisionRecord& record : records) {
        EXPECT_EQ(epoch.high, heard < 500 ? 0.0 : 500.0);
        EXPECT_EQ(record.time, heard);
        EXPECT_EQ(record.slot_i, heard % 4);
        EXPECT_EQ(record.slot_j, (heard + 1) % 4);
        EXPECT_EQ(record.before_i[1], 1.0);
        EXPECT_EQ(record.before_j[1], 2.0);
        EXPECT_EQ(record.after_i[1], 3.0);
        EXPECT_EQ(record.after_j[1], 4.0);
        ++heard;
      }
    };
    if (room > 0) listener.room = [&] { return std::span(memory).first(room); };
    recorder.listen(std::move(listener));
    EXPECT_TRUE(recorder.active());
    EXPECT_FALSE(recorder.logging());
    for (int k = 0; k < 500; ++k) record(recorder, k);
    recorder.begin_epoch({500.0, 0.0});
    EXPECT_EQ(heard, 500);
    for (int k = 500; k < 1000; ++k) record(recorder, k);
    recorder.hand_over();
    EXPECT_EQ(heard, 1000);
    recorder.listen({});
    EXPECT_FALSE(recorder.active());
    EXPECT_TRUE(taken_from(recorder).empty());
  }
}

TEST(CollisionRecorder, WhatLeftAVelocityThatIsNotFiniteIsTakenBack) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CollisionRecorder recorder(reversed_ids, V(0, 0));
  recorder.withdraw_collision();
  recorder.withdraw_hit();
  recorder.log_events(true);
  record(recorder, 0);
  recorder.record(1.0, 0, 1, V(0, 0), V(0, 0), V(nan, 0), V(0, 0));
  recorder.withdraw_collision();
  recorder.log_hit(2.0, 0, wall_left, V(1, 0));
  recorder.withdraw_hit();  // which is finite, and stays
  recorder.log_hit(3.0, 0, wall_left, V(nan, 0));
  recorder.withdraw_hit();
  const std::vector<Event> events = taken_from(recorder);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].time, 0.0);
  EXPECT_EQ(events[1].time, 2.0);
}

}  // namespace
}  // namespace carom::test
