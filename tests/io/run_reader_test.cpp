// Runs read back: what the engine had is what the reader gives, and every kind of directory that is no finished run is refused in
// one sentence.

#include "io/hdf5_handle.hpp"
#include "support/child_process.hpp"
#include "support/recorded_run.hpp"
#include "support/refusal.hpp"

#include <carom/io/run_reader.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <hdf5.h>

#include <thread>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string mixture = R"(
title = "Two kinds"
[box]
x = [-1.0, 4.0]
y = [0.0, 4.0]
boundary = { x = "periodic", y = "walls" }
[[disks]]
name = "large"
count = 6
radius = 0.3
mass = 2.0
positions = "random"
velocities = { temperature = 1.0 }
[[disks]]
name = "small"
count = 9
radius = 0.1
mass = 0.5
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[walls]
top = { velocity = 0.25 }
[run]
time = 3.0
sample_every = 0.25
[output]
events = true
)";

class RunReaderTest : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path recorded(const std::vector<std::string>& overrides = {}) {
    record(parse_scene(mixture, "mixture", overrides), run_);
    return run_;
  }
  [[nodiscard]] std::string refusal(const fs::path& path) const {
    return test::refusal<OutputError>([&] { const RunReader reader(path); });
  }
  void cut(const std::string& name, std::size_t bytes) const {
    const std::string whole = text_of(run_ / name);
    write_text(run_ / name, whole.substr(0, std::min(bytes, whole.size())));
  }

  TemporaryDirectory directory_;
  fs::path run_ = directory_.path() / "run";
};

TEST_F(RunReaderTest, GivesWhatPistonsAndPairPotentialsKeep) {
  for (const char* potential :
       {"square_well={ width = 1.4, depth = 0.5 }",
        "stepped_potential={ steps = [{ width = 1.2, energy = 0.5 }, { width = 1.5, energy = -0.3 }] }"}) {
    const std::vector<std::string> overrides = {"walls.top={ mass = 5.0, load = 0.5 }", "run.equilibrate={ time = 1.0 }",
                                                potential};
    const RunReader reader(recorded(overrides));
    Simulation simulation = make_simulation(parse_scene(mixture, "mixture", overrides));
    RunHooks hooks;
    std::uint64_t moving = 0, bound = 0;
    hooks.sample = [&](std::uint64_t k, const State& expected) {
      const State state = reader.sample(k);
      EXPECT_EQ(state.walls[3].position, expected.walls[3].position);
      EXPECT_EQ(state.walls[3].velocity, expected.walls[3].velocity);
      EXPECT_EQ(state.bonds, expected.bonds);
      EXPECT_EQ(state.pairs_in_steps, expected.pairs_in_steps);
      if (state.walls[3].velocity != 0.0) ++moving;
      bound += state.bonds;
    };
    run_schedule(simulation, hooks);
    EXPECT_EQ(moving, 13U);
    EXPECT_GT(bound, 0U);
    fs::remove_all(run_);
  }
}

TEST_F(RunReaderTest, GivesPairsInStepsThatAChangeBringsIn) {
  record(
      parse_scene(
          mixture + "[[changes]]\ntime = 1.0\nset = [\"stepped_potential.steps=[{ width = 1.2, energy = 0.5 }, { width "
                    "= 1.5, energy = -0.3 }]\"]\n",
          "mixture",
          {"walls.top.velocity=0", "stepped_potential={ steps = [{ width = 1.2, energy = 0 }, { width = 1.5, energy = 0 }] }"}),
      run_);
  const RunReader reader(run_);
  ASSERT_EQ(reader.samples(), 13U);
  EXPECT_EQ(reader.sample(12).pairs_in_steps.size(), 2U);
  const State first = reader.sample(0);
  EXPECT_TRUE(first.positions.allFinite());
}

TEST_F(RunReaderTest, GivesStatesAndEventsOfTheEngineBitByBit) {
  const RunReader reader(recorded());
  Simulation simulation = make_simulation(parse_scene(mixture));
  simulation.record_events(true);
  ASSERT_EQ(reader.samples(), 13U);
  std::vector<Event> events;
  for (std::uint64_t k = 0; k < reader.samples(); ++k) {
    simulation.run_until(0.25 * static_cast<double>(k));
    const State expected = simulation.state();
    const State state = reader.sample(k);
    EXPECT_EQ(state.time, expected.time);
    EXPECT_EQ(state.positions, expected.positions);
    EXPECT_EQ(state.velocities, expected.velocities);
    ASSERT_EQ(state.walls.size(), 4U);
    EXPECT_EQ(state.walls[3].position, expected.walls[3].position);
    EXPECT_EQ(state.walls[3].velocity, 0.25);
    for (const Event& event : simulation.take_events()) events.push_back(event);
  }
  const std::vector<Event> log = reader.event_log();
  ASSERT_EQ(log.size(), events.size());
  ASSERT_GT(log.size(), 20U);
  for (std::size_t e = 0; e < log.size(); ++e) {
    EXPECT_EQ(log[e].time, events[e].time);
    EXPECT_EQ(log[e].disk, events[e].disk);
    EXPECT_EQ(log[e].partner, events[e].partner);
    EXPECT_EQ(log[e].velocity, events[e].velocity);
    EXPECT_EQ(log[e].partner_velocity, events[e].partner_velocity);
  }
}

TEST_F(RunReaderTest, RefusesSamplesAndEventsThatAreNotThere) {
  const RunReader reader(recorded());
  EXPECT_THAT(test::refusal<OutputError>([&] { return reader.sample(13); }),
              EndsWith("there is no sample 13; the last one is 12"));
  EXPECT_THAT(test::refusal<OutputError>([&] { return reader.totals(~std::uint64_t{0}); }), EndsWith("the last one is 12"));
  EXPECT_THAT(test::refusal<OutputError>([&] { return reader.event_log(0, ~std::uint64_t{0}, 0.0); }),
              HasSubstr("there are no events 0 to"));
  EXPECT_THAT(test::refusal<OutputError>([&] { return reader.event_log(reader.events() - 1, 2, 0.0); }),
              HasSubstr("the number of events is"));
  EXPECT_EQ(reader.event_log(reader.events() - 1, 1, 0.0).size(), 1U);
}

TEST_F(RunReaderTest, SaysWhereARunKeptNoEvents) {
  const RunReader reader(recorded({"output.events=false"}));
  EXPECT_TRUE(reader.event_log().empty());
  EXPECT_THAT(test::refusal<OutputError>([&] { return reader.start(); }),
              EndsWith("this run kept no events; run it with output.events = true"));
}

TEST_F(RunReaderTest, KnowsTheSceneAndItsDisks) {
  const RunReader reader(recorded());
  EXPECT_EQ(reader.title(), "Two kinds");
  EXPECT_THAT(reader.species_names(), ElementsAre("large", "small"));
  EXPECT_EQ(reader.disks().radius[0], 0.3);
  EXPECT_EQ(reader.disks().mass[14], 0.5);
  EXPECT_EQ(reader.disks().species[6], 1);
  EXPECT_EQ(reader.scene().box.upper, Eigen::Vector2d(4.0, 4.0));
  EXPECT_EQ(reader.scene().effects.walls[3].velocity, 0.25);
  EXPECT_EQ(reader.end(), 3.0);
  EXPECT_FALSE(reader.Z());  // a wall moves
}

TEST_F(RunReaderTest, FoldsUnwrappedPositionsIntoTheBox) {
  const RunReader reader(recorded({"output.unwrapped=true"}));
  bool leaves = false;
  Simulation simulation = make_simulation(parse_scene(mixture));
  simulation.run_until(3.0);
  const State expected = simulation.state();
  const State state = reader.sample(12);
  for (Eigen::Index i = 0; i < 15; ++i) {
    leaves = leaves || expected.images(0, i) != 0;
    // Adding some box lengths of 5 and taking them away again rounds twice, at numbers below 32.
    EXPECT_NEAR(state.positions(0, i), expected.positions(0, i), 2 * 32 * 0x1p-53);
  }
  EXPECT_TRUE(leaves);
}

TEST_F(RunReaderTest, ReadsARunWhoseStartFileIsGone) {
  const std::string start = directory_.file("start.csv");
  write_text(start, "x,y,vx,vy\n1,1,0.5,0.25\n3,3,0,-1\n");
  const std::string scene =
      "[box]\nx = [0, 4]\ny = [0, 4]\nboundary = \"walls\"\n[[disks]]\nradius = 0.5\nmass = 1.0\npositions = { file = \"" +
      start +
      "\" }\n[collision]\nrule = \"specular\"\n[run]\ntime = 2.0\nsample_every = 1.0\n[gravity]\nacceleration = [0, -1]\n";
  record(parse_scene(scene), run_);
  fs::remove(start);
  const RunReader reader(run_);
  EXPECT_EQ(reader.sample(0).positions.col(1), Eigen::Vector2d(3.0, 3.0));
  EXPECT_EQ(reader.scene().effects.gravity->acceleration.y(), -1.0);
  EXPECT_FALSE(reader.has_event_log());
}

TEST_F(RunReaderTest, RefusesWhatIsNoRun) {
  EXPECT_THAT(refusal(directory_.path() / "nowhere"), HasSubstr("there is no such directory"));
  EXPECT_THAT(refusal(directory_.path()), AllOf(StartsWith(directory_.path().string() + ": "), HasSubstr("no finished run")));
  write_text(directory_.path() / "file.xyz", "1\n");
  EXPECT_THAT(refusal(directory_.path() / "file.xyz"), HasSubstr("this is a file; name the run directory"));
}

TEST_F(RunReaderTest, RefusesARunThatStillGoesOn) {
  const fs::path run = recorded();
  fs::remove(run / "summary.json");
  fs::rename(run / "trajectory.h5md", run / "trajectory.h5md.partial");
  EXPECT_THAT(refusal(run), HasSubstr("this run still goes on"));
}

TEST_F(RunReaderTest, HasTheEventsOfARunWithoutSamples) {
  const RunReader run(recorded({"output.trajectory=false"}));
  EXPECT_EQ(run.samples(), 0U);
  EXPECT_EQ(run.event_log().size(), run.events());
  EXPECT_GT(run.events(), 0U);
  EXPECT_EQ(run.start().positions.cols(), static_cast<Eigen::Index>(run.disks().count()));
  EXPECT_THROW((void)run.sample_times(), OutputError);
  EXPECT_THROW((void)run.sample(0), OutputError);
}

TEST_F(RunReaderTest, KnowsObstaclesThatComeDuringTheRun) {
  const std::string scene =
      "[box]\nx = [0, 4]\ny = [0, 4]\nboundary = \"walls\"\n[[disks]]\nradius = 0.5\nmass = 1\npositions = [[1, 1]]\n"
      "velocities = [[1, 0]]\n[collision]\nrule = \"specular\"\n[run]\ntime = 4.0\nsample_every = 1.0\n"
      "[output]\nevents = true\n[[changes]]\ntime = 0.5\nadd_obstacle = { segment = { from = [3, 0], to = [3, 4] } }\n";
  record(parse_scene(scene), run_);
  const std::vector<Event> log = RunReader(run_).event_log();
  ASSERT_EQ(log.size(), 2U);
  EXPECT_EQ(log[0].partner, first_obstacle);
  EXPECT_EQ(log[0].time, 1.5);
  EXPECT_EQ(log[1].partner, wall_left);
}

TEST_F(RunReaderTest, RefusesARunWithoutATrajectory) {
  (void)recorded();
  fs::remove(run_ / "trajectory.h5md");
  EXPECT_THAT(refusal(run_), HasSubstr("kept no trajectory.h5md; run the scene again with output.trajectory = true"));
}

TEST_F(RunReaderTest, RefusesARunWithoutSamples) {
  const std::string scene =
      "[box]\nx = [0, 4]\ny = [0, 4]\nboundary = \"walls\"\n[[disks]]\nradius = 0.5\nmass = 1\npositions = [[1, 1]]\n"
      "velocities = [[1, 0]]\n[collision]\nrule = \"specular\"\n[run]\ntime = 4.0\n";
  record(parse_scene(scene), run_);
  EXPECT_THAT(refusal(run_), HasSubstr("kept no trajectory.h5md; run the scene again with run.sample_every"));
}

/// Also the second time: a dataset that cannot be opened is not one that is not there.
TEST_F(RunReaderTest, RefusesADamagedDatasetEachTime) {
  const std::string spins = "observables/spin/value";
  record(parse_scene(mixture, "mixture", {"walls.top.velocity=0", "collision.roughness=0.5"}), run_);
  const fs::path file = run_ / "trajectory.h5md";
  haddr_t header = 0;
  {
    const detail::Hdf5Id opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    H5O_info_t info;
    ASSERT_GE(H5Oget_info_by_name(opened.get(), spins.c_str(), &info, H5P_DEFAULT), 0);
    header = info.addr;
  }
  std::string bytes = text_of(file);
  bytes.replace(header, 16, 16, '\xff');
  write_text(file, bytes);
  const RunReader reader(run_);
  for (int k = 0; k < 2; ++k)
    EXPECT_THAT(test::refusal<OutputError>([&] { (void)reader.sample(1); }), HasSubstr("it is damaged or cut short"));
}

/// The data race would be between datasets that are opened when they are first asked for.
TEST_F(RunReaderTest, IsReadByThreadsSideBySide) {
  hbool_t is_safe = 0;
  ASSERT_GE(H5is_library_threadsafe(&is_safe), 0);
  if (is_safe == 0) GTEST_SKIP() << "HDF5 is not built for threads here";
  const fs::path run = recorded();
  for (int repeat = 0; repeat < 20; ++repeat) {
    const RunReader reader(run);
    std::vector<State> states(4);
    {
      std::vector<std::jthread> threads;
      for (State& state : states) threads.emplace_back([&] { state = reader.sample(7); });
    }
    for (const State& state : states) EXPECT_EQ(state_hash(state), state_hash(states[0]));
    EXPECT_EQ(state_hash(states[0]), state_hash(RunReader(run).sample(7)));
  }
}

TEST_F(RunReaderTest, RefusesFilesThatAreCutShort) {
  const fs::path run = recorded();
  const std::string whole = text_of(run / "trajectory.h5md");
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    write_text(run / "trajectory.h5md", whole);
    cut("trajectory.h5md", bytes);
    EXPECT_THAT(refusal(run), AllOf(HasSubstr("trajectory.h5md: HDF5 cannot read this file"), HasSubstr("cut short")));
  }
  write_text(run / "trajectory.h5md", whole);
  cut("summary.json", 200);
  EXPECT_THAT(refusal(run), HasSubstr("summary.json: this is not the summary of a run"));
}

}  // namespace
}  // namespace carom::test
