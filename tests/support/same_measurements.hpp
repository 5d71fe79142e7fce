#pragma once
// Two lists of measurements that are to be the same to the last bit.

#include <carom/observe.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace carom::test {

inline void expect_same_measurements(const std::vector<Measurement>& a, const std::vector<Measurement>& b) {
  const auto same = [](double x, double y) { return x == y || (x != x && y != y); };
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t m = 0; m < a.size(); ++m) {
    ASSERT_EQ(a[m].scalars.size(), b[m].scalars.size());
    for (std::size_t s = 0; s < a[m].scalars.size(); ++s) {
      EXPECT_EQ(a[m].scalars[s].value, b[m].scalars[s].value) << a[m].name << "." << a[m].scalars[s].name;
      EXPECT_EQ(a[m].scalars[s].error, b[m].scalars[s].error) << a[m].name << "." << a[m].scalars[s].name;
    }
    ASSERT_EQ(a[m].tables.size(), b[m].tables.size());
    for (std::size_t t = 0; t < a[m].tables.size(); ++t)
      for (std::size_t c = 0; c < a[m].tables[t].columns.size(); ++c)
        EXPECT_TRUE(std::ranges::equal(a[m].tables[t].columns[c].values, b[m].tables[t].columns[c].values, same))
            << a[m].name << "." << a[m].tables[t].columns[c].name;
  }
}

}  // namespace carom::test
