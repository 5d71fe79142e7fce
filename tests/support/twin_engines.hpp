#pragma once
// Two engines of the catalogue event by event, for as long as rounding lets two orders of arithmetic agree.
//
// How long that is the textbook engine tells itself: double against 64 bits. Chaos makes every error grow alike, so until
// event k the fast engine may be off from 64 bits by a factor of 1000 more than the textbook engine in double precision has been
// so far (which starts as low as 1e-17 by chance), and the comparison ends where that bound comes near the gaps between events.

#include "support/engines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::test {

inline double difference(const Event& a, const Event& b) {
  return std::abs((a.time - b.time) + (a.time_remainder - b.time_remainder));
}

inline bool same_partners(const Event& a, const Event& b) { return a.disk == b.disk && a.partner == b.partner; }

inline void expect_no_faults(const AnyEngine& engine) {
  const auto faults = engine.check_invariants();
  ASSERT_TRUE(faults.empty()) << faults.front() << ", and " << faults.size() - 1 << " more, after "
                              << engine.totals().pair + engine.totals().wall << " collisions";
}

/// Compares at most `most` events of the engine `name` with those of the textbook engine, and returns how many there were before
/// rounding made an end of it. Looks at the invariants `checks` times on the way. make(name) makes an engine.
template <class Make>
std::size_t compare_with_textbook(Make&& make, const std::string& name, std::size_t most, std::size_t checks) {
  const auto textbook = make("textbook");
  const auto precise = make("textbook-long-double");
  const auto fast = make(name);
  const std::vector<Event> expected = next_events(*precise, most);
  const std::vector<Event> rounded = next_events(*textbook, most);
  std::uint64_t looked = 0;
  const std::vector<Event> found = next_events(*fast, most, forever, 20, [&](AnyEngine& engine) {
    const std::uint64_t collisions = engine.totals().pair + engine.totals().wall;
    if (collisions < looked * most / checks) return;
    looked = collisions * checks / most + 1;
    expect_no_faults(engine);
  });
  EXPECT_EQ(expected.size(), most);
  EXPECT_EQ(found.size(), most);

  const double gap = expected.back().time / static_cast<double>(most);
  double bound = 0.0;
  std::size_t k = 0;
  for (; k < std::min({most, found.size(), rounded.size()}); ++k) {
    if (!same_partners(rounded[k], expected[k])) break;
    bound = std::max({bound, 1000.0 * difference(rounded[k], expected[k]), 1e-15 * expected[k].time, 1e-13 * gap});
    if (bound > 1e-2 * gap) break;
    if (!same_partners(found[k], expected[k]) || difference(found[k], expected[k]) > bound) {
      ADD_FAILURE() << "event " << k << " of " << found[k].disk << ", " << found[k].partner << " at " << found[k].time
                    << " instead of " << expected[k].disk << ", " << expected[k].partner << " at " << expected[k].time
                    << "; off by " << difference(found[k], expected[k]) << " where " << bound << " is allowed";
      break;
    }
  }
  return k;
}

}  // namespace carom::test
