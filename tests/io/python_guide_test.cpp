// docs/python.md does what it says, where the packages are installed.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace carom::test {
namespace {

TEST(ScenesPythonGuide, EveryBlockRunsOnTheFilesOfTheRunItNames) {
  const TemporaryDirectory directory;
  const Outcome run = run_carom(directory.path(), {"run", CAROM_SOURCE_DIR "/docs/scenes/box.toml", "--set", "run.time=1",
                                                   "--set", "run.sample_every=0.01", "--xyz", "--csv", "--events"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Outcome gas = run_carom(
      directory.path(), {"run", CAROM_SOURCE_DIR "/docs/scenes/gas.toml", "--set", "run.sample_every=false", "--set",
                         "run.sample_log={ base = 1.3, per_block = 40, block = 100.0 }"});
  ASSERT_EQ(gas.exit_code, 0) << gas.err;
  Outcome outcome;
  for (const char* python : {"/usr/bin/python3", "python3"}) {
    outcome =
        run_program(directory.path(), {python, CAROM_SOURCE_DIR "/tests/io/run_guide.py", CAROM_SOURCE_DIR "/docs/python.md"});
    if (outcome.exit_code != 77 && outcome.exit_code != 127) break;
  }
  if (outcome.exit_code == 77 || outcome.exit_code == 127) GTEST_SKIP() << "h5py, matplotlib or MDAnalysis is not installed";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("10 blocks"));
  // What numpy wrote is a start, as text and in its own format.
  for (const char* start : {"start.npy", "start.csv"}) {
    const Outcome mine = run_carom(directory.path(), {"run", "mine.toml", "--set", std::string("disks.0.positions.file=") + start,
                                                      "--out", start + std::string(".run"), "--force"});
    EXPECT_EQ(mine.exit_code, 0) << mine.err;
  }
  for (const char* picture : {"speeds.png", "box.gif"})
    EXPECT_GT(std::filesystem::file_size(directory.file(picture)), 1000U) << picture;
}

}  // namespace
}  // namespace carom::test
