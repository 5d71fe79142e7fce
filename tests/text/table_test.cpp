// Tables of the terminal.

#include "text/table.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace carom::test {
namespace {

TEST(TerminalTable, ColumnsAreAsWideAsTheirWidestCell) {
  TerminalTable table("lrl");
  table.add({"method", "error", "remark"});
  table.add({"fast", "1e-15", ""});
  table.add({"naive-edge", "2", "walls at the edge"});
  EXPECT_EQ(table.text(),
            "  method      error  remark\n"
            "  fast        1e-15\n"
            "  naive-edge      2  walls at the edge\n");
}

TEST(TerminalTable, AShortRowEndsInFreeTextAndAnEmptyOneIsAnEmptyLine) {
  TerminalTable table("lll");
  table.add({"time", "5", "as asked"});
  table.add({"energy", "a sentence that is longer than its column"});
  table.add({});
  table.add({"Z"});
  EXPECT_EQ(table.text(),
            "  time    5  as asked\n"
            "  energy  a sentence that is longer than its column\n"
            "\n"
            "  Z\n");
}

TEST(TerminalTable, WidthsCountCharactersAndNotBytes) {
  TerminalTable table("lr");
  table.add({"µ", "1.0 ± 0.1"});
  table.add({"ab", "1.0 + 0.1"});
  EXPECT_EQ(table.text(), "  µ   1.0 ± 0.1\n  ab  1.0 + 0.1\n");
}

TEST(TerminalTable, MoreCellsThanColumnsAreRefused) {
  TerminalTable table("l");
  EXPECT_THROW(table.add({"a", "b"}), std::invalid_argument);
}

}  // namespace
}  // namespace carom::test
