#pragma once
// Two logs of events that are to be the same.

#include <carom/state.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace carom::test {

inline bool same_event(const Event& a, const Event& b) {
  return a.time == b.time && a.time_remainder == b.time_remainder && a.disk == b.disk && a.partner == b.partner &&
         a.velocity == b.velocity && a.partner_velocity == b.partner_velocity;
}

inline testing::AssertionResult same_events(const std::vector<Event>& a, const std::vector<Event>& b) {
  if (a.size() != b.size()) return testing::AssertionFailure() << a.size() << " events and " << b.size();
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!same_event(a[k], b[k])) return testing::AssertionFailure() << "event " << k << " at time " << a[k].time << " differs";
  }
  return testing::AssertionSuccess();
}

}  // namespace carom::test
