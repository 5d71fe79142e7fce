// Replays against samples: whatever acts, free flight and the event log lead to where the engine has the disks, the pistons too.

#include "pages/replay.hpp"

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <carom/simulation.hpp>

#include <ostream>

namespace carom::test {
namespace {

std::string gas_in(const std::string& boundary, const std::string& more = {}) {
  return "[box]\nx = [0.0, 8.0]\ny = [0.0, 6.0]\nboundary = " + boundary +
         "\n[[disks]]\ncount = 30\nradius = 0.25\nmass = 2.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n"
         "[collision]\nrule = \"specular\"\n" +
         more + "\n[run]\ntime = 8.0\nsample_every = 0.5\n";
}

struct Recorded {
  Scene scene;
  Disks disks;
  std::vector<State> samples;
  std::vector<Event> events;
};

Recorded recorded(const std::string& text) {
  Simulation simulation = make_simulation(parse_scene(text));
  Recorded run{simulation.scene(), simulation.disks(), {}, {}};
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t, const State& state) { run.samples.push_back(state); };
  hooks.events = [&](std::span<const Event> events) { run.events.insert(run.events.end(), events.begin(), events.end()); };
  run_schedule(simulation, hooks);
  return run;
}

double distance(const Recorded& run, const std::vector<Event>& events) {
  return distance_from_samples(run.scene, Replay(run.scene, run.disks, run.samples[0]), events, run.samples.size(),
                               [&](std::uint64_t k) { return run.samples[k]; });
}

struct Case {
  std::string name, scene;
};
void PrintTo(const Case& run, std::ostream* out) { *out << run.name; }
class ReplayOf : public ::testing::TestWithParam<Case> {};

// Per flight: the end rounds four times at places below 16, times below 8 are rounded to doubles at speeds below 16. A disk has
// some hundreds of flights; what rescaled velocities add is smaller.
constexpr double rounding = 1000 * (4 * 16 + 8 * 16) * 0x1p-53;

TEST_P(ReplayOf, EventsLeadToEverySample) {
  const Recorded run = recorded(GetParam().scene);
  ASSERT_GT(run.events.size(), 50U);
  EXPECT_EQ(why_no_replay(run.scene), "");
  EXPECT_LT(distance(run, run.events), rounding);
}

TEST_P(ReplayOf, AMissingEventIsNoticed) {
  const Recorded run = recorded(GetParam().scene);
  std::vector<Event> events = run.events;
  events.erase(events.begin() + 20);
  EXPECT_GT(distance(run, events), 1e-3);  // a thousandth of what a disk of ordinary speed travels in the second that is left
}

INSTANTIATE_TEST_SUITE_P(
    Effects, ReplayOf,
    ::testing::Values(
        Case{"walls", gas_in("\"walls\"")}, Case{"periodic", gas_in("\"periodic\"")},
        Case{"gravity", gas_in("\"walls\"", "[gravity]\nacceleration = [0.0, -0.5]")},
        Case{"obstacles", gas_in("\"walls\"", "[[obstacles]]\ndisk = { centre = [4.0, 3.0], radius = 1.0 }")},
        Case{"moving_wall", gas_in("\"walls\"", "[walls]\nright = { velocity = 0.3 }")},
        Case{"pistons", gas_in("\"walls\"", "[walls]\nright = { mass = 10.0, load = 1.0 }\nbottom = { mass = 5.0, load = 1.0 }")},
        Case{"hot_wall", gas_in("\"walls\"", "[walls]\nleft = { temperature = 2.0 }")},
        Case{"growth", gas_in("\"periodic\"", "[growth]\nrate = 0.05")},
        Case{"inelastic", gas_in("\"walls\"", "restitution = 0.9")}, Case{"rough", gas_in("\"walls\"", "roughness = 0.5")},
        Case{"well", gas_in("\"periodic\"", "[square_well]\nwidth = 1.5\ndepth = 0.5")}),
    [](const auto& tested) { return tested.param.name; });

TEST(Replay, PistonsAreWhereTheEngineHasThem) {
  const Recorded run =
      recorded(gas_in("\"walls\"", "[walls]\nright = { mass = 10.0, load = 1.0 }\nbottom = { mass = 5.0, load = 1.0 }"));
  Replay replay(run.scene, run.disks, run.samples[0]);
  std::size_t next = 0;
  for (const State& state : run.samples) {
    for (; next < run.events.size() && run.events[next].time <= state.time; ++next) replay.apply(run.events[next]);
    for (std::size_t side = 0; side < 4; ++side) {
      // Each hit rounds the momentum by some units of it, and 8 units of time carry that on.
      EXPECT_NEAR(replay.wall_position(side, state.time), state.walls[side].position, 8 * rounding);
    }
  }
  EXPECT_NE(run.samples.back().walls[1].position, 8.0);
}

TEST(Replay, APistonThatIsElsewhereIsFound) {
  const Recorded run = recorded(gas_in("\"walls\"", "[walls]\nright = { mass = 10.0, load = 1.0 }"));
  const auto farthest = [&](const State& start) {
    return distance_from_samples(run.scene, Replay(run.scene, run.disks, start), run.events, run.samples.size(),
                                 [&](std::uint64_t k) { return run.samples[k]; });
  };
  State start = run.samples[0];
  EXPECT_LT(farthest(start), 8 * rounding);
  start.walls[1].velocity += 0.25;
  EXPECT_NEAR(farthest(start), 0.25 * run.samples.back().time, 8 * rounding);
}

TEST(Replay, SaysWhatTheLogDoesNotHold) {
  EXPECT_THAT(why_no_replay(parse_scene(gas_in("\"periodic\"", "[thermostat]\ntemperature = 1.0\nrate = 0.5"))),
              ::testing::HasSubstr("thermostat"));
  EXPECT_THAT(why_no_replay(parse_scene(gas_in("\"periodic\"", "[shear]\nrate = 0.5"))), ::testing::HasSubstr("shear"));
  EXPECT_THAT(why_no_replay(parse_scene(gas_in("\"periodic\"", "roughness = 0.5\n[growth]\nrate = 0.05"))),
              ::testing::HasSubstr("spins"));
}

TEST(Replay, SingleDigitsRoundEveryVelocity) {
  const Recorded run = recorded(gas_in("\"walls\""));
  Replay replay(run.scene, run.disks, run.samples[0], VelocityDigits::single);
  for (const Event& event : run.events) {
    replay.apply(event);
    const Eigen::Vector2d v = replay.velocity(static_cast<std::size_t>(event.disk), event.time);
    EXPECT_EQ(v, event.velocity.cast<float>().cast<double>().eval());
  }
}

}  // namespace
}  // namespace carom::test
