// Names of points: short, unique, and fit for a file system.

#include "studies/sweep/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carom::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Not;
using ::testing::StartsWith;

TEST(SweepNames, KeysAreCutToWhatTellsThemApart) {
  EXPECT_THAT(short_keys({"disks.0.radius", "run.time"}), ElementsAre("radius", "time"));
  EXPECT_THAT(short_keys({"disks.0.radius", "disks.1.radius", "time"}), ElementsAre("0.radius", "1.radius", "time"));
  EXPECT_THAT(short_keys({"walls.left.temperature", "temperature"}), ElementsAre("left.temperature", "temperature"));
  EXPECT_THAT(short_keys({"a.b.c", "b.c", "c"}), ElementsAre("a.b.c", "b.c", "c"));
}

TEST(SweepNames, ValuesBecomeNames) {
  const auto name = [](const std::string& value) { return point_name({"k"}, {value}); };
  EXPECT_EQ(name("0.1"), "k=0.1");
  EXPECT_EQ(name("-1e-300"), "k=-1e-300");
  EXPECT_EQ(name("true"), "k=true");
  EXPECT_EQ(name("\"periodic\""), "k=periodic");
  EXPECT_EQ(name("[0.0, -1.0]"), "k=0.0--1.0");
  EXPECT_EQ(name("{ \"temperature\" = 2.0 }"), "k=temperature-2.0");
  EXPECT_EQ(name("\"../../etc/passwd\""), "k=..-..-etc-passwd");
  EXPECT_EQ(name("\"\xc3\xa4 $(x)\""), "k=x");
  EXPECT_EQ(name("\"\""), "k=");
}

TEST(SweepNames, LongValuesKeepTheirBeginningAndDifferInTheirEnd) {
  const std::string many = "[[0.5, 0.5], [1.5, 0.5], [2.5, 0.5], [3.5, 0.5], [4.5, 0.5], [5.5, 0.5]";
  const std::string one = point_name({"positions"}, {many + "]"}), other = point_name({"positions"}, {many + ", [6.5, 0.5]]"});
  EXPECT_THAT(one, StartsWith("positions=0.5-0.5-1.5-0.5-2.5-0.5-"));
  EXPECT_EQ(one.size(), std::string("positions=").size() + 24 + 1 + 8);
  EXPECT_NE(one, other);
}

TEST(SweepNames, AbsentValuesAreLeftOut) {
  EXPECT_EQ(point_name({"a", "b", "c"}, {"1", "", "3"}), "a=1_c=3");
  EXPECT_EQ(point_name({"a"}, {""}), "scene");
  EXPECT_EQ(point_name({}, {}), "scene");
}

TEST(SweepNames, UsersMayNotNameWhatLeavesTheDirectory) {
  for (const char* name : {"dense", "eta=0.7", "a.b_c+d-e", "0"}) EXPECT_TRUE(is_point_name(name)) << name;
  for (const char* name : {"", ".", "..", "a/b", "-x", " a", "a b", ".lock", "\xc3\xa4"})
    EXPECT_FALSE(is_point_name(name)) << name;
  EXPECT_FALSE(is_point_name(std::string(101, 'a')));
}

}  // namespace
}  // namespace carom::test
