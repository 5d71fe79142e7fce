#pragma once
// Events of a simulation that was changed, and of its twin.

#include <carom/state.hpp>

#include <gtest/gtest.h>

#include <optional>

namespace carom::test {

/// The same kind of event of the same disks at the same velocities; times are counted from different zeros.
inline void expect_twin_event(const std::optional<Event>& event, const std::optional<Event>& twin, double begun, int step) {
  ASSERT_EQ(event.has_value(), twin.has_value()) << "step " << step;
  if (!event) return;
  EXPECT_NEAR(event->time, begun + twin->time, 4e-16 * event->time) << "step " << step;
  ASSERT_EQ(event->disk, twin->disk) << "step " << step;
  ASSERT_EQ(event->partner, twin->partner) << "step " << step;
  ASSERT_EQ(event->velocity, twin->velocity) << "step " << step;
  ASSERT_EQ(event->partner_velocity, twin->partner_velocity) << "step " << step;
}

}  // namespace carom::test
