// The files of one run together: which are written, when they get their names, and what an exception leaves.

#include "io/run_writer.hpp"

#include "io/h5md_reader.hpp"
#include "io/hand_made_run.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

std::vector<std::string> names_in(const fs::path& path) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(RunWriter, WritesEveryProductAskedForAndTheSummaryLast) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(2, 2);
  scene.output = {.trajectory = true, .xyz = true, .csv = true, .events = true};
  RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
  EXPECT_THAT(names_in(temporary.path()),
              ElementsAre("samples.csv.partial", "trajectory.h5md.partial", "trajectory.xyz.partial"));
  for (std::uint64_t k = 0; k < 3; ++k) writer.sample(k, state_at(k, scene), {});
  writer.events(events_up_to(5));
  EXPECT_THAT(writer.finish(hand_made_report(scene)),
              ElementsAre("trajectory.h5md", "trajectory.xyz", "samples.csv", "summary.json"));
  EXPECT_THAT(names_in(temporary.path()), ElementsAre("samples.csv", "summary.json", "trajectory.h5md", "trajectory.xyz"));
  EXPECT_EQ(nlohmann::json::parse(text_of(temporary.path() / "summary.json"))["scene"], "hand_made.toml");
}

TEST(RunWriter, WritesOnlyTheSummaryWhereNothingElseIsAskedFor) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(1, 1);
  scene.output = {.trajectory = false};
  RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
  writer.sample(0, state_at(0, scene), {});
  writer.events(events_up_to(5));
  EXPECT_THAT(writer.finish(hand_made_report(scene)), ElementsAre("summary.json"));
  EXPECT_THAT(names_in(temporary.path()), ElementsAre("summary.json"));
}

TEST(RunWriter, WithoutASamplingGridThereAreNoFilesOfSamples) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(1, 1);
  scene.run.sample_every.reset();
  scene.output = {.trajectory = true, .xyz = true, .csv = true};
  RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
  EXPECT_THAT(writer.finish(hand_made_report(scene)), ElementsAre("summary.json"));
}

TEST(RunWriter, EventsAloneGoIntoATrajectoryWithoutSamples) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(1, 1);
  scene.output = {.trajectory = false, .events = true};
  RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
  writer.sample(0, state_at(0, scene), {});
  writer.events(events_up_to(5));
  EXPECT_THAT(writer.finish(hand_made_report(scene)), ElementsAre("trajectory.h5md", "summary.json"));
  const H5Reader file(temporary.path() / "trajectory.h5md");
  EXPECT_THAT(file.extents("/events/time"), ElementsAre(5));
  EXPECT_THAT(file.extents("/particles/trajectory/position/value"), ElementsAre(0, 2, 3));
}

TEST(RunWriter, UnwrappedPositionsContinuePastPeriodicEdgesOnly) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(2, 0);
  scene.species.pop_back();
  scene.output.unwrapped = true;
  scene.output.csv = true;
  RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
  State state = state_at(0, scene);
  state.positions << 0.5, 2.0, 11.0, 12.0;  // disk 0 at (0.5, 11), disk 1 at (2, 12)
  state.images << 3, -2, 0, 0;
  writer.sample(0, state, {});
  writer.finish(hand_made_report(scene));
  const H5Reader file(temporary.path() / "trajectory.h5md");
  EXPECT_THAT(file.doubles("/particles/trajectory/position/value"), ElementsAre(12.5, 11.0, 0.0, -6.0, 12.0, 0.0));
  EXPECT_THAT(file.ints("/particles/trajectory/image/value"), ElementsAre(3, 0, 0, -2, 0, 0));
  EXPECT_THAT(text_of(temporary.path() / "samples.csv"), ::testing::HasSubstr("\n0.0,0,12.5,11.0,"));
}

TEST(RunWriter, AnExceptionInTheRunKeepsTheDataAsPartialFiles) {
  const TemporaryDirectory temporary;
  Scene scene = scene_of(2, 2);
  scene.output.xyz = true;
  scene.output.events = true;
  try {
    RunWriter writer(RunDirectory(temporary.path(), false), scene, hand_made_disks(scene), provenance());
    for (std::uint64_t k = 0; k < 7; ++k) writer.sample(k, state_at(k, scene), {});
    writer.events(events_up_to(3));
    throw std::runtime_error("the physics failed");
  } catch (const std::runtime_error&) {
  }
  EXPECT_THAT(names_in(temporary.path()), ElementsAre("trajectory.h5md.partial", "trajectory.xyz.partial"));
  const H5Reader file(temporary.path() / "trajectory.h5md.partial");
  EXPECT_THAT(file.extents("/particles/trajectory/position/value"), ElementsAre(7, 4, 3));
  EXPECT_THAT(file.extents("/events/time"), ElementsAre(3));
}

TEST(RunWriter, ARunThatNeverBeganLeavesNothing) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path() / "out", false);
  Scene scene = scene_of(2, 2);
  scene.output.csv = true;
  { const RunWriter writer(directory, scene, hand_made_disks(scene), provenance()); }
  directory.discard_if_empty();
  EXPECT_FALSE(fs::exists(temporary.path() / "out"));
}

TEST(RunWriter, AFileThatCannotBeOpenedTakesTheOthersBack) {
  const TemporaryDirectory temporary;
  const RunDirectory directory(temporary.path(), false);
  fs::create_directory(temporary.path() / "samples.csv.partial");
  Scene scene = scene_of(2, 2);
  scene.output.csv = true;
  EXPECT_THROW(RunWriter(directory, scene, hand_made_disks(scene), provenance()), OutputError);
  EXPECT_FALSE(fs::exists(temporary.path() / "trajectory.h5md.partial"));
}

}  // namespace
}  // namespace carom::test
