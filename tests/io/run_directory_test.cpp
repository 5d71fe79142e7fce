// Where a run writes, what it refuses to overwrite, and what it leaves alone.

#include "io/run_directory.hpp"

#include "io/hand_made_run.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(RunDirectory, IsCreatedWithItsParents) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path() / "a" / "b", false);
  EXPECT_TRUE(fs::is_directory(temporary.path() / "a" / "b"));
  EXPECT_EQ(directory.final_name("summary.json"), temporary.path() / "a" / "b" / "summary.json");
  EXPECT_EQ(directory.partial_name("summary.json"), temporary.path() / "a" / "b" / "summary.json.partial");
}

TEST(RunDirectory, ASlashAtTheEndOfTheNameChangesNothing) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path() / "a" / "b" / "", false);
  EXPECT_TRUE(fs::is_directory(temporary.path() / "a" / "b"));
  directory.discard_if_empty();
  EXPECT_FALSE(fs::exists(temporary.path() / "a"));
}

TEST(RunDirectory, CheckingThatItIsWritableLeavesNothingBehind) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path(), false);
  EXPECT_TRUE(fs::is_empty(temporary.path()));
}

TEST(RunDirectory, DiscardingRemovesOnlyWhatItMadeAndOnlyWhenEmpty) {
  const TemporaryDirectory temporary;
  {
    const RunDirectory directory(temporary.path() / "a" / "b", false);
    directory.discard_if_empty();
    EXPECT_FALSE(fs::exists(temporary.path() / "a"));
  }
  {
    const RunDirectory directory(temporary.path() / "a" / "b", false);
    write_text(temporary.path() / "a" / "note", "keep");
    directory.discard_if_empty();
    EXPECT_FALSE(fs::exists(temporary.path() / "a" / "b"));
    EXPECT_EQ(text_of(temporary.path() / "a" / "note"), "keep");
  }
  const RunDirectory old(temporary.path(), false);
  old.discard_if_empty();
  EXPECT_TRUE(fs::exists(temporary.path()));
}

class RunDirectoryWithResults : public ::testing::TestWithParam<std::string> {};

TEST_P(RunDirectoryWithResults, IsRefusedAndUntouchedWithoutForce) {
  const TemporaryDirectory temporary;
  write_text(temporary.path() / GetParam(), "old");
  const std::string message = refusal<OutputError>([&] { const RunDirectory directory(temporary.path(), false); });
  EXPECT_THAT(message,
              AllOf(HasSubstr(temporary.path().string()), HasSubstr(GetParam()), HasSubstr("--force"), HasSubstr("--out")));
  EXPECT_EQ(text_of(temporary.path() / GetParam()), "old");
}

TEST_P(RunDirectoryWithResults, IsClearedOfResultsAndNothingElseWithForce) {
  const TemporaryDirectory temporary;
  write_text(temporary.path() / GetParam(), "old");
  write_text(temporary.path() / "notes.txt", "mine");
  write_text(temporary.path() / "trajectory.h5md.bak", "mine too");
  const RunDirectory directory(temporary.path(), true);
  EXPECT_FALSE(fs::exists(temporary.path() / GetParam()));
  EXPECT_EQ(text_of(temporary.path() / "notes.txt"), "mine");
  EXPECT_EQ(text_of(temporary.path() / "trajectory.h5md.bak"), "mine too");
}

INSTANTIATE_TEST_SUITE_P(RunDirectory, RunDirectoryWithResults,
                         ::testing::Values("summary.json", "trajectory.h5md", "trajectory.xyz", "samples.csv",
                                           "trajectory.h5md.partial", "samples.csv.partial"));

TEST(RunDirectory, OtherFilesAreNoObstacle) {
  const TemporaryDirectory temporary;
  write_text(temporary.path() / "box.toml", "scene");
  const RunDirectory directory(temporary.path(), false);
  EXPECT_EQ(text_of(temporary.path() / "box.toml"), "scene");
}

TEST(RunDirectory, AFileInItsPlaceIsNamed) {
  const TemporaryDirectory temporary;
  write_text(temporary.path() / "file", "text");
  EXPECT_THAT(refusal<OutputError>([&] { const RunDirectory directory(temporary.path() / "file", true); }),
              AllOf(HasSubstr((temporary.path() / "file").string()), HasSubstr("is a file"), HasSubstr("--out")));
  EXPECT_THAT(refusal<OutputError>([&] { const RunDirectory directory(temporary.path() / "file" / "below", true); }),
              AllOf(HasSubstr("Not a directory"), HasSubstr("--out")));
  EXPECT_EQ(text_of(temporary.path() / "file"), "text");
}

TEST(RunDirectory, ADirectoryInThePlaceOfAProductIsRefusedEvenWithForce) {
  const TemporaryDirectory temporary;
  fs::create_directory(temporary.path() / "summary.json");
  EXPECT_THAT(refusal<OutputError>([&] { const RunDirectory directory(temporary.path(), true); }), HasSubstr("summary.json"));
  EXPECT_TRUE(fs::is_directory(temporary.path() / "summary.json"));
}

TEST(RunDirectory, ALinkToAnOldResultIsRemovedAndItsTargetStays) {
  const TemporaryDirectory temporary;
  write_text(temporary.path() / "precious", "data");
  fs::create_symlink(temporary.path() / "precious", temporary.path() / "trajectory.h5md");
  const RunDirectory directory(temporary.path(), true);
  EXPECT_FALSE(fs::is_symlink(temporary.path() / "trajectory.h5md"));
  EXPECT_EQ(text_of(temporary.path() / "precious"), "data");
}

TEST(RunDirectory, APlaceWhereNothingCanBeWrittenIsNamedBeforeTheRun) {
  // /proc refuses new files and directories even to root
  const std::string message = refusal<OutputError>([] { const RunDirectory directory("/proc/carom", false); });
  EXPECT_THAT(message, AllOf(HasSubstr("/proc/carom"), HasSubstr("--out")));
  EXPECT_THAT(refusal<OutputError>([] { const RunDirectory directory("/proc/self", false); }), HasSubstr("/proc/self"));
}

TEST(RunDirectory, AReadOnlyDirectoryIsRefused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryDirectory temporary;
  fs::permissions(temporary.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(refusal<OutputError>([&] { const RunDirectory directory(temporary.path(), false); }),
              HasSubstr("Permission denied"));
  EXPECT_THAT(refusal<OutputError>([&] { const RunDirectory directory(temporary.path() / "a" / "b", false); }),
              HasSubstr("Permission denied"));
  fs::permissions(temporary.path(), fs::perms::owner_all);
}

TEST(RunDirectory, AnEmptyNameIsRefused) {
  EXPECT_THAT(refusal<OutputError>([] { const RunDirectory directory("", false); }), HasSubstr("--out"));
}

TEST(RunDirectory, PublishingGivesTheFileItsName) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path(), false);
  write_text(directory.partial_name("summary.json"), "{}");
  directory.publish("summary.json");
  EXPECT_EQ(text_of(directory.final_name("summary.json")), "{}");
  EXPECT_FALSE(fs::exists(directory.partial_name("summary.json")));
}

TEST(RunDirectory, PublishingWhatIsMissingNamesIt) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path(), false);
  EXPECT_THAT(refusal<OutputError>([&] { directory.publish("samples.csv"); }),
              AllOf(HasSubstr("samples.csv.partial"), HasSubstr("No such file")));
}

}  // namespace
}  // namespace carom::test
