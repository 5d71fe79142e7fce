// One run, from its files and from memory: both play the same.

#include "pages/playback.hpp"
#include "pages/player_data.hpp"

#include "support/child_process.hpp"
#include "support/recorded_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <random>

namespace carom::test {
namespace {

std::string gas_between(const std::string& boundary, const std::string& more = {}) {
  return "[box]\nx = [0.0, 8.0]\ny = [0.0, 6.0]\nboundary = " + boundary +
         "\n[[disks]]\ncount = 30\nradius = 0.25\nmass = 2.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n"
         "[collision]\nrule = \"specular\"\n" +
         more + "\n[run]\ntime = 6.0\nsample_every = 0.5\n[output]\nevents = true\n";
}

/// Samples at each half, and all collisions, from now to `until`.
Recording recorded_until(Simulation& simulation, double until) {
  std::vector<State> samples = {simulation.state()};
  simulation.record_events(true);
  for (double time = simulation.time() + 0.5; time <= until; time += 0.5) {
    simulation.run_until(time);
    samples.push_back(simulation.state());
  }
  std::vector<Event> events = simulation.take_events();
  simulation.record_events(false);
  return recording_in_memory(simulation.scene(), simulation.disks(), std::move(samples), std::move(events));
}

TEST(Recording, OfOneRunPlaysTheSameFromFilesAndFromMemory) {
  const Scene scene = parse_scene(gas_between("{ x = \"periodic\", y = \"walls\" }"));
  const TemporaryDirectory directory;
  record(scene, directory.path() / "run");
  const RunReader files(directory.path() / "run");
  Simulation simulation = make_simulation(scene);
  const Recording memory = recorded_until(simulation, 6.0);
  EXPECT_GT(memory.events, 100U);
  EXPECT_EQ(memory.events, files.events());

  Playback from_files(files), from_memory(memory);
  ASSERT_TRUE(from_files.exact() && from_memory.exact());
  EXPECT_EQ(from_memory.end(), from_files.end());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any_time(0.0, 6.0);
  for (int k = 0; k < 20; ++k) {
    const double time = any_time(random);
    EXPECT_EQ(from_memory.at(time).positions, from_files.at(time).positions) << time;
    EXPECT_EQ(from_memory.at(time).collisions, from_files.at(time).collisions) << time;
  }

  const PlayerData page = player_data(files), page_from_memory = player_data(memory);
  EXPECT_EQ(page_from_memory.columns, page.columns);
  auto words = nlohmann::json::parse(page.description), words_from_memory = nlohmann::json::parse(page_from_memory.description);
  for (const char* key : {"Z", "facts"}) words.erase(key), words_from_memory.erase(key);  // of the whole run, in its summary
  EXPECT_EQ(words_from_memory, words);
}

struct Beginning {
  std::string name, boundary, more;
};
void PrintTo(const Beginning& one, std::ostream* out) { *out << one.name; }

class LaterRecording : public ::testing::TestWithParam<Beginning> {};

TEST_P(LaterRecording, PlaysFromItsOwnBeginningWithTheEnginesPositions) {
  Simulation simulation = make_simulation(parse_scene(gas_between(GetParam().boundary, GetParam().more)));
  simulation.run_until(2.25);
  Simulation twin = make_simulation(simulation.scene());
  twin.run_until(2.25);
  Playback playback(recorded_until(simulation, 6.25));
  ASSERT_TRUE(playback.exact()) << playback.why_not();
  EXPECT_EQ(playback.begin(), 0.0);
  EXPECT_EQ(playback.end(), 4.0);
  for (const double time : {0.0, 0.7, 1.9, 3.3, 4.0}) {
    twin.run_until(2.25 + time);
    const State expected = twin.state();
    Eigen::Matrix2Xd apart = playback.at(time).positions - expected.positions;
    for (int axis = 0; axis < 2; ++axis) {
      const double l = twin.scene().box.lengths()[axis];
      if (twin.scene().box.periodic(axis)) apart.row(axis) -= l * (apart.row(axis) / l).array().round().matrix();
    }
    EXPECT_LT(apart.cwiseAbs().maxCoeff(), 1e-9) << time;
  }
}

INSTANTIATE_TEST_SUITE_P(All, LaterRecording,
                         ::testing::Values(Beginning{"Gas", "\"periodic\"", ""},
                                           Beginning{"Falling", "\"walls\"", "[gravity]\nacceleration = [0.0, -1.0]"},
                                           Beginning{"MovingWall", "\"walls\"", "[walls]\nright = { velocity = -0.2 }"},
                                           Beginning{"Piston", "\"walls\"", "[walls]\nright = { mass = 20.0, load = 2.0 }"}),
                         [](const auto& one) { return one.param.name; });

TEST(Recording, WithoutItsCollisionsPlaysBetweenSamplesAndSaysWhy) {
  Simulation simulation = make_simulation(parse_scene(gas_between("\"walls\"")));
  std::vector<State> samples = {simulation.state()};
  simulation.run_until(1.0);
  samples.push_back(simulation.state());
  const Recording recording =
      recording_in_memory(simulation.scene(), simulation.disks(), samples, "a fixed step has no collisions in between");
  Playback playback(recording);
  EXPECT_EQ(playback.why_not(), "a fixed step has no collisions in between");
  const Eigen::Matrix2Xd middle = (samples[0].positions + samples[1].positions) / 2;
  EXPECT_LT((playback.at(0.5).positions - middle).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_FALSE(player_data(recording).exact);
}

}  // namespace
}  // namespace carom::test
