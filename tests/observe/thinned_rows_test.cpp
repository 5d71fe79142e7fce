// Rows of which every second is left out where there would be too many.

#include "observe/thinned_rows.hpp"

#include "core/archive.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace carom::test {
namespace {

/// Rows at the instants from `first` up to `end`, each with its square.
void add_instants(ThinnedRows& rows, int first, int end) {
  for (int k = first; k < end; ++k)
    if (rows.takes_next()) rows.add(k, {static_cast<double>(k) * k});
}

TEST(ThinnedRows, AreOfInstantsAtEqualSteps) {
  ThinnedRows rows(1);
  add_instants(rows, 0, 3001);  // a row for every fourth: 1024 rows at steps of 2 end at 2046
  ASSERT_EQ(rows.times().size(), 751U);
  for (std::size_t k = 0; k < rows.times().size(); ++k) {
    EXPECT_EQ(rows.times()[k], 4.0 * static_cast<double>(k));
    EXPECT_EQ(rows.column(0)[k], rows.times()[k] * rows.times()[k]);
  }
}

TEST(ThinnedRows, GoOnWhereTheyWereSaved) {
  // Behind 1500 instants every second one has a row; 1501 is none of them.
  ThinnedRows whole(1), first(1), rest(1);
  add_instants(whole, 0, 4000);
  add_instants(first, 0, 1501);
  std::stringstream saved;
  SavingArchive out(saved);
  out(first);
  LoadingArchive in(saved);
  in(rest);
  add_instants(rest, 1501, 4000);
  EXPECT_EQ(rest.times(), whole.times());
  EXPECT_EQ(rest.column(0), whole.column(0));
}

}  // namespace
}  // namespace carom::test
