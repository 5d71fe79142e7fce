// A recorded run at any time, against the engine that made it.

#include "pages/playback.hpp"

#include "support/child_process.hpp"
#include "support/recorded_run.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

const std::string played_gas = R"(
[box]
x = [0.0, 8.0]
y = [-3.0, 3.0]
boundary = { x = "periodic", y = "walls" }
[[disks]]
count = 30
radius = 0.25
mass = 2.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[run]
time = 6.0
sample_every = 0.5
[output]
events = true
)";

/// One disk that meets nothing.
const std::vector<std::string> free_flight = {"disks.0.count=1", "box.boundary=periodic", "disks.0.positions=[[4.0, 0.0]]",
                                              "disks.0.velocities=[[3.0, 2.5]]"};

class PlaybackTest : public ::testing::Test {
 protected:
  void play(const std::vector<std::string>& overrides = {}, const PlaybackOptions& options = {}) {
    scene_ = parse_scene(played_gas, "gas", overrides);
    record(scene_, directory_.path() / "run");
    run_.emplace(directory_.path() / "run");
    playback_.emplace(*run_, options);
  }
  static double length(const std::vector<Stretch>& trail) {
    return std::accumulate(trail.begin(), trail.end(), 0.0,
                           [](double sum, const Stretch& s) { return sum + (s.to - s.from).norm(); });
  }
  /// The largest distance from the engine's disks, the short way round.
  double distance_at(Simulation& simulation, double time) {
    simulation.run_until(time);
    const State expected = simulation.state();
    const Moment& moment = playback_->at(time);
    EXPECT_EQ(moment.time, time);
    Eigen::Matrix2Xd apart = moment.positions - expected.positions;
    for (int axis = 0; axis < 2; ++axis)
      if (scene_.box.periodic(axis)) {
        const double l = scene_.box.lengths()[axis];
        apart.row(axis) -= l * (apart.row(axis) / l).array().round().matrix();
      }
    return apart.colwise().norm().maxCoeff();
  }

  TemporaryDirectory directory_;
  Scene scene_;
  std::optional<RunReader> run_;
  std::optional<Playback> playback_;
};

TEST_F(PlaybackTest, ARunWithItsEventsIsExactAtAnyTime) {
  play();
  ASSERT_TRUE(playback_->exact());
  EXPECT_EQ(playback_->begin(), 0.0);
  EXPECT_EQ(playback_->end(), 6.0);
  Simulation simulation = make_simulation(scene_);
  // A few hundred flights are rounded a few times each, at 1e-15 of the box; chaos does not come in, since velocities are
  // recorded.
  for (const double time : {0.0, 0.13, 1.7, 1.7000001, 3.3, 5.99, 6.0}) EXPECT_LT(distance_at(simulation, time), 1e-11) << time;
  std::uint64_t collisions = 0;
  for (const std::uint64_t one : playback_->at(6.0).collisions) collisions += one;
  EXPECT_EQ(collisions, 2 * simulation.totals().pair + simulation.totals().wall);
}

TEST_F(PlaybackTest, TimeMayGoBack) {
  play();
  const Eigen::Matrix2Xd before = playback_->at(1.3).positions;
  playback_->at(5.0);
  EXPECT_EQ(playback_->at(1.3).positions, before);
}

TEST_F(PlaybackTest, PistonsAndGrowingDisksAreWhereTheEngineHasThem) {
  play({"box.boundary=walls", "walls.top.mass=30.0", "walls.top.load=0.5"});
  ASSERT_TRUE(playback_->exact()) << playback_->why_not();
  Simulation piston = make_simulation(scene_);
  EXPECT_LT(distance_at(piston, 4.2), 1e-11);
  // The log says what a disk loses at the piston; of what the piston has then, each of some hundred pushes is rounded.
  EXPECT_NEAR(playback_->at(4.2).sides[3], piston.state().walls[3].position, 1e-11);

  std::filesystem::remove_all(directory_.path() / "run");
  play({"growth.rate=0.02"});
  ASSERT_TRUE(playback_->exact()) << playback_->why_not();
  Simulation growing = make_simulation(scene_);
  EXPECT_LT(distance_at(growing, 4.2), 1e-11);
  // The engine adds up growth from one zero of its clock to the next, and rounds each time.
  const double roundings = 2.0 + static_cast<double>(growing.totals().numerics.epochs);
  EXPECT_NEAR(playback_->at(4.2).scale, growing.state().scale, roundings * 0x1p-52);
}

TEST_F(PlaybackTest, WithoutEventsDisksGoStraightFromSampleToSample) {
  play({"output.events=false"});
  EXPECT_FALSE(playback_->exact());
  EXPECT_THAT(playback_->why_not(), HasSubstr("kept no event log"));
  for (std::uint64_t k = 0; k < run_->samples(); ++k) {
    const State sample = run_->sample(k);
    EXPECT_EQ(playback_->at(sample.time).positions, sample.positions) << k;
    EXPECT_EQ(playback_->at(sample.time).velocities, sample.velocities) << k;
  }
  EXPECT_TRUE(playback_->at(1.1).collisions.empty());
}

TEST_F(PlaybackTest, AFreeDiskIsExactAcrossPeriodicEdgesWithoutEventsToo) {
  std::vector<std::string> overrides = free_flight;
  overrides.emplace_back("output.events=false");
  play(overrides);
  Simulation simulation = make_simulation(scene_);
  for (const double time : {0.7, 1.21, 1.3, 2.9, 5.75}) EXPECT_LT(distance_at(simulation, time), 1e-13) << time;
}

TEST_F(PlaybackTest, AFreeDiskCrossesTheEdgesOfAShearedBoxWhereItShould) {
  std::vector<std::string> overrides = free_flight;
  overrides.emplace_back("shear.rate=0.3");
  play(overrides);
  ASSERT_FALSE(playback_->exact());
  Simulation simulation = make_simulation(scene_);
  // Its velocity changes at an edge by as much as the images beyond move: seen from where it came from it flies straight on.
  for (const double time : {0.7, 1.21, 1.3, 2.9, 3.4, 4.1, 5.75}) EXPECT_LT(distance_at(simulation, time), 1e-12) << time;
}

TEST_F(PlaybackTest, TooManyEventsAreNotKept) {
  play({}, {.most_events = 10});
  EXPECT_FALSE(playback_->exact());
  EXPECT_THAT(playback_->why_not(), HasSubstr("more than the 10 that are kept in memory"));
}

TEST_F(PlaybackTest, TrailsAreAsLongAsTheWayThatDisksCame) {
  play({}, {.trail = 1.5});
  const Moment before = playback_->at(2.0);
  // Speeds change at collisions alone, so the way is the sum of speed times time between them; here, from the log.
  std::vector<double> way(30, 0.0), since(30, 0.5), speed;
  std::vector<double> first(30);
  Simulation simulation = make_simulation(scene_);
  const State start = simulation.state();
  for (Eigen::Index i = 0; i < 30; ++i) first[static_cast<std::size_t>(i)] = start.velocities.col(i).norm();
  speed = first;
  for (const Event& event : run_->event_log()) {
    if (event.time > 2.0) break;
    const auto turn = [&](std::int32_t disk, const Eigen::Vector2d& v) {
      const auto i = static_cast<std::size_t>(disk);
      way[i] += speed[i] * std::max(0.0, event.time - since[i]);
      since[i] = std::max(since[i], event.time);
      speed[i] = v.norm();
    };
    turn(event.disk, event.velocity);
    if (event.partner >= 0) turn(event.partner, event.partner_velocity);
  }
  ASSERT_EQ(before.trails.size(), 30U);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_NEAR(length(before.trails[i]), way[i] + speed[i] * (2.0 - since[i]), 1e-10) << i;
}

TEST_F(PlaybackTest, OneSpeciesAloneMayLeaveTrails) {
  play({"disks=[{count=3,radius=0.2,mass=1.0,positions=\"random\",velocities={speed=1.0}},"
        "{count=2,radius=0.3,mass=1.0,positions=\"random\",velocities={speed=1.0}}]"},
       {.trail = 1.0, .trails_of = 0});
  const Moment& moment = playback_->at(2.0);
  ASSERT_EQ(moment.trails.size(), 3U);
  for (const auto& trail : moment.trails) EXPECT_FALSE(trail.empty());
}

TEST_F(PlaybackTest, TrailsOfAFreeDiskEndAtTheDiskAndStayInTheBox) {
  for (const char* const events : {"output.events=true", "output.events=false"}) {
    std::filesystem::remove_all(directory_.path() / "run");
    std::vector<std::string> overrides = free_flight;
    overrides.emplace_back(events);
    play(overrides, {.trail = 4.0});
    const Moment moment = playback_->at(5.3);
    const std::vector<Stretch>& trail = moment.trails.at(0);
    EXPECT_NEAR(length(trail), 4.0 * std::hypot(3.0, 2.5), 1e-10) << events;
    const Eigen::Vector2d end = trail.back().to;
    EXPECT_LT((end + into_box(scene_.box, end) - moment.positions.col(0)).norm(), 1e-12);
    for (const Stretch& stretch : trail) EXPECT_EQ(into_box(scene_.box, stretch.from).norm(), 0.0);
  }
}

TEST_F(PlaybackTest, TrailsUnderGravityAreParabolas) {
  play({"disks.0.count=1", "box.boundary=walls", "disks.0.positions=[[2.0, 2.0]]", "disks.0.velocities=[[1.0, 0.0]]",
        "gravity.acceleration=[0.0, -1.0]", "run.time=2.0"},
       {.trail = 1.0});
  const Stretch stretch = playback_->at(1.5).trails.at(0).at(0);
  const Eigen::Vector2d halfway = 0.25 * (stretch.from + 2.0 * stretch.middle + stretch.to);
  EXPECT_NEAR(halfway.x(), 3.0, 1e-14);
  EXPECT_NEAR(halfway.y(), 2.0 - 0.5, 1e-14);  // fallen for 1
}

TEST(IntoBox, GoesThroughAsManyEdgesAsItTakes) {
  const Box box{{0.0, 0.0}, {2.0, 4.0}, {Boundary::periodic, Boundary::periodic}};
  EXPECT_EQ(into_box(box, {1.0, 1.0}), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(into_box(box, {-0.5, 9.0}), Eigen::Vector2d(2.0, -8.0));
  EXPECT_EQ(into_box(box, {0.5, 5.0}, 1.5), Eigen::Vector2d(0.5, -4.0));  // -1.5 for the image, then back in
  EXPECT_EQ(into_box({{0.0, 0.0}, {2.0, 4.0}, {Boundary::walls, Boundary::walls}}, {5.0, 5.0}), Eigen::Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace carom::test
