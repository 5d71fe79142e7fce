// Trajectories of other programs: their files, and what is said of them against exact events.

#include "studies/compare/external_trajectory.hpp"
#include "studies/compare/trajectory_file.hpp"
#include "support/child_process.hpp"
#include "support/refusal.hpp"
#include "support/systems.hpp"
#include "support/temporary_directory.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

class ExternalTrajectoryFile : public ::testing::Test {
 protected:
  ExternalTrajectoryFile() : scene_(gas_scene(3, 0.1, Boundary::periodic, 1)), disks_(make_simulation(scene_).disks()) {}

  std::vector<State> read(const std::string& name, const std::string& bytes, std::optional<double> every = {}) {
    write_text(directory_.file(name), bytes);
    return read_trajectory_file(directory_.file(name), scene_, disks_, every);
  }
  void refused(const std::string& name, const std::string& bytes, const std::string& sentence, std::optional<double> every = {}) {
    EXPECT_THAT(refusal<std::exception>([&] { return read(name, bytes, every); }), HasSubstr(sentence));
  }

  TemporaryDirectory directory_;
  Scene scene_;
  Disks disks_;
};

/// An array of doubles as numpy.save writes it on this machine, which is little-endian wherever the tests run.
std::string saved_array(const std::string& shape, bool fortran, const std::vector<double>& values) {
  std::string header =
      "{'descr': '<f8', 'fortran_order': " + std::string(fortran ? "True" : "False") + ", 'shape': " + shape + ", }\n";
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size());
  bytes += '\0';
  bytes += header;
  const std::size_t begin = bytes.size();
  bytes.resize(begin + values.size() * sizeof(double));
  std::memcpy(bytes.data() + begin, values.data(), values.size() * sizeof(double));
  return bytes;
}

TEST_F(ExternalTrajectoryFile, OfAnArrayHasFramesDisksAndColumnsInBothOrders) {
  std::vector<double> rows, columns;
  const auto value = [](int k, int i, int c) { return 0.1 + 0.4 * k + 0.02 * i + 0.001 * c; };
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 4; ++c) rows.push_back(value(k, i, c));
  for (int c = 0; c < 4; ++c)
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 2; ++k) columns.push_back(value(k, i, c));
  for (const std::string& bytes : {saved_array("(2, 3, 4)", false, rows), saved_array("(2, 3, 4)", true, columns)}) {
    const std::vector<State> frames = read("a.npy", bytes, 0.5);
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[1].time, 0.5);
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(frames[static_cast<std::size_t>(k)].positions(0, i), value(k, i, 0));
        EXPECT_EQ(frames[static_cast<std::size_t>(k)].positions(1, i), value(k, i, 1));
        EXPECT_EQ(frames[static_cast<std::size_t>(k)].velocities(1, i), value(k, i, 3));
      }
  }
}

TEST_F(ExternalTrajectoryFile, OfATableMayHaveItsColumnsAndDisksInAnyOrder) {
  const std::vector<State> frames =
      read("a.csv", "x,y,time,disk\n0.5,0.25,0,1\n0.1,0.2,0,0\n0.75,1,0,2\n1,1,0.5,0\n0.5,0.5,0.5,1\n0.25,0.5,0.5,2\n");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].positions(0, 1), 0.5);
  EXPECT_EQ(frames[1].time, 0.5);
  EXPECT_EQ(frames[1].positions(1, 2), 0.5);
  EXPECT_EQ(frames[0].velocities.cols(), 0);
}

TEST_F(ExternalTrajectoryFile, OfATableIsReadAsSpreadsheetsPandasNumpyAndRWriteIt) {
  const std::string rows = "0,0,1,2\r\n0,1,1.5,1\r\n\r\n0, 2, +2, 2\r\n";
  for (const char* names :
       {"\xEF\xBB\xBFtime,disk,x,y\r\n", "\"time\",\"disk\",\"x\",\"y\"\n", "# time,disk,x,y\n", "time, id, x, y\n"}) {
    const std::vector<State> frames = read("a.csv", names + rows);
    ASSERT_EQ(frames.size(), 1U) << names;
    EXPECT_EQ(frames[0].positions, (Eigen::Matrix2Xd(2, 3) << 1.0, 1.5, 2.0, 2.0, 1.0, 2.0).finished()) << names;
  }
  refused("a.csv", rows, "a.csv:1:1: there is no column time; the first row must name the columns");
}

TEST_F(ExternalTrajectoryFile, MayGoOnPastPeriodicEdges) {
  const double length = scene_.box.lengths().x();
  const std::string x = std::to_string(0.25 + 3.0 * length);
  const std::vector<State> frames = read("a.csv", "time,disk,x,y\n0,0," + x + ",0.5\n0,1,1,1\n0,2,2,2\n");
  EXPECT_NEAR(frames[0].positions(0, 0), 0.25, 1e-5);
}

TEST_F(ExternalTrajectoryFile, IsRefusedWithItsFirstDifference) {
  const std::vector<double> six(12, 0.5);
  refused("a.npy", saved_array("(2, 3, 2)", false, six), "give the time between frames, --every DT");
  EXPECT_THAT(refusal<SceneError>([&] { return read_trajectory_file("nowhere.npy", scene_, disks_, std::nullopt); }),
              HasSubstr("there is no such file; check the path"));
  refused("a.npy", saved_array("(3, 2, 2)", false, six), "its frames have 2 disks and the scene has 3", 0.1);
  refused("a.npy", saved_array("(4, 3)", false, six), "the shape (4, 3)", 0.1);
  refused("a.npy", saved_array("(3, 3, 2)", false, six), "the file ends early", 0.1);
  refused("a.csv", "time,disk,x\n", "there is no column y");
  refused("a.csv", "time,disk,x,y\n0,3,1,1\n", "disk 3 is none of the scene's");
  refused("a.csv", "time,disk,x,y\n0,0,1,1\n0,0,1,1\n", "disk 0 stands twice in the frame at t = 0");
  refused("a.csv", "time,disk,x,y\n0,0,1,1\n0,2,1,1\n", "ends without disk 1");
  refused("a.csv", "time,disk,x,y\n0,0,1,one\n", "y is \"one\", which is no finite number");
  refused("a.csv", "time,disk,x,y\n1,0,1,1\n1,1,1,1\n1,2,1,1\n0,0,1,1\n0,1,1,1\n0,2,1,1\n", "times must increase");
  refused("a.csv", "time,disk,x,y\n", "there are no frames");
  refused("a.csv", "time,disk,x,y\n", "leave it out", 0.1);
  refused("a.dump", "", "a trajectory ends in .npy, .csv or .h5md");
}

TEST(ExternalTrajectories, AreHeldAgainstExactEventsFrameByFrame) {
  const Scene scene = gas_scene(20, 0.3, Boundary::periodic, 1);
  const State start = make_simulation(scene).state();
  const auto go_on = [](double) { return true; };
  std::vector<State> exact, moved;
  Simulation simulation = make_simulation(scene, start);
  for (int k = 0; k < 5; ++k) {
    simulation.run_until(0.05 * k);
    State state = simulation.state();
    exact.push_back(state);
    if (k >= 2) state.positions(0, 7) += 0.001 * k;
    if (k == 4) state.velocities *= 1.1;
    moved.push_back(state);
  }
  const std::optional<ExternalTrajectory> right = compare_trajectory(scene, start, exact, go_on);
  ASSERT_TRUE(right);
  EXPECT_FALSE(right->departure);
  EXPECT_EQ(right->overlapping, 0U);
  EXPECT_NEAR(*right->energy_drift, 0.0, 1e-13);
  const std::optional<ExternalTrajectory> wrong = compare_trajectory(scene, start, moved, go_on);
  ASSERT_TRUE(wrong);
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(wrong->distances[static_cast<std::size_t>(k)].largest, k < 2 ? 0.0 : 0.001 * k, 1e-10);
    EXPECT_NEAR(wrong->distances[static_cast<std::size_t>(k)].rms, k < 2 ? 0.0 : 0.001 * k / std::sqrt(20.0), 1e-10);
  }
  EXPECT_EQ(wrong->distances[3].disk, 7);
  EXPECT_NEAR(*wrong->energy_drift, 0.21, 1e-12);
  EXPECT_FALSE(compare_trajectory(scene, start, exact, [](double) { return false; }));
  moved.front().positions(1, 3) += 0.1;
  EXPECT_THROW((void)compare_trajectory(scene, start, moved, go_on), std::invalid_argument);
}

TEST(ExternalTrajectories, CountFramesInWhichDisksOverlap) {
  const Scene scene = gas_scene(20, 0.3, Boundary::periodic, 1);
  const State start = make_simulation(scene).state();
  State later = start;
  later.time = 0.01;
  later.positions.col(1) = later.positions.col(0) + Eigen::Vector2d(0.25, 0.0);  // two disks of diameter 1
  if (later.positions(0, 1) >= scene.box.upper.x()) later.positions(0, 1) -= scene.box.lengths().x();
  const auto compared = compare_trajectory(scene, start, {start, later}, [](double) { return true; });
  ASSERT_TRUE(compared);
  EXPECT_EQ(compared->overlapping, 1U);
  EXPECT_GE(compared->deepest_overlap, 0.75 - 1e-12);
  EXPECT_EQ(compared->deepest_time, 0.01);
  ASSERT_TRUE(compared->departure);
  EXPECT_EQ(compared->departure->time, 0.01);
}

}  // namespace
}  // namespace carom::test
