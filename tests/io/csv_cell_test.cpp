// Numbers of tables tell their type, and read back as they were.

#include "io/csv_cell.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace carom::test {
namespace {

TEST(CsvCell, OfAWholeDoubleHasAPoint) {
  EXPECT_EQ(csv_cell(0.0), "0.0");
  EXPECT_EQ(csv_cell(-0.0), "-0.0");
  EXPECT_EQ(csv_cell(-12.0), "-12.0");
  EXPECT_EQ(csv_cell(0.1), "0.1");
}

TEST(CsvCell, WithAnExponentNeedsNone) {
  EXPECT_EQ(csv_cell(1e300), "1e+300");
  EXPECT_EQ(csv_cell(5e-324), "5e-324");
}

TEST(CsvCell, OfWhatIsNoNumberIsNaN) {
  EXPECT_EQ(csv_cell(std::numeric_limits<double>::quiet_NaN()), "NaN");
  EXPECT_EQ(csv_cell(std::numeric_limits<double>::infinity()), "NaN");
}

}  // namespace
}  // namespace carom::test
