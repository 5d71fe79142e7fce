// docs/python-files.md and the blocks of docs/output.md do what they say, where the packages are installed.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace carom::test {
namespace {

/// Makes box/, which both pages read.
void run_box(const TemporaryDirectory& directory) {
  const Outcome run = run_carom(directory.path(), {"run", CAROM_SOURCE_DIR "/docs/scenes/box.toml", "--set", "run.time=1",
                                                   "--set", "run.sample_every=0.01", "--xyz", "--csv", "--events"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
}

/// Runs the blocks of a page; exit code 77 where no Python has the packages.
Outcome run_blocks(const TemporaryDirectory& directory, const std::string& page) {
  Outcome outcome;
  for (const char* python : {"/usr/bin/python3", "python3"}) {
    outcome =
        run_program(directory.path(), {python, CAROM_SOURCE_DIR "/tests/io/run_guide.py", CAROM_SOURCE_DIR "/docs/" + page});
    if (outcome.exit_code == 127) outcome.exit_code = 77;
    if (outcome.exit_code != 77) break;
  }
  return outcome;
}

TEST(ScenesPythonGuide, EveryBlockRunsOnTheFilesOfTheRunItNames) {
  const TemporaryDirectory directory;
  run_box(directory);
  const Outcome gas =
      run_carom(directory.path(), {"run", CAROM_SOURCE_DIR "/docs/scenes/gas.toml", "--set", "run.sample_every=false", "--set",
                                   "run.sample_log={ base = 1.3, per_block = 40, block = 100.0 }"});
  ASSERT_EQ(gas.exit_code, 0) << gas.err;
  const Outcome outcome = run_blocks(directory, "python-files.md");
  if (outcome.exit_code == 77) GTEST_SKIP() << "h5py, matplotlib or MDAnalysis is not installed";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("10 blocks"));
  // What numpy wrote is a start, as text and in its own format.
  for (const char* start : {"start.npy", "start.csv"}) {
    const Outcome mine = run_carom(directory.path(), {"run", "mine.toml", "--set", std::string("disks.0.positions.file=") + start,
                                                      "--out", start + std::string(".run"), "--force"});
    EXPECT_EQ(mine.exit_code, 0) << mine.err;
  }
  EXPECT_THAT(text_of(directory.file("speeds.png")), testing::StartsWith("\x89PNG\r\n\x1a\n"));
  EXPECT_THAT(text_of(directory.file("box.gif")), testing::StartsWith("GIF89a"));
}

TEST(ScenesOutputGuide, EveryBlockRunsOnTheFilesOfARun) {
  const TemporaryDirectory directory;
  run_box(directory);
  const Outcome observe =
      run_carom(directory.path(), {"run", CAROM_SOURCE_DIR "/docs/scenes/observe.toml", "--set", "run.time=20"});
  ASSERT_EQ(observe.exit_code, 0) << observe.err;
  const Outcome outcome = run_blocks(directory, "output.md");
  if (outcome.exit_code == 77) GTEST_SKIP() << "h5py or MDAnalysis is not installed";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("7 blocks"));
}

}  // namespace
}  // namespace carom::test
