// The changes of a scene are made at their times, between events. The twin of a scene with changes is a simulation to which a
// program makes them by set_effects() and set_velocities(): both end in the same bits, whatever drives the run, wherever it
// pauses or is saved, and on however many threads.

#include "live/live_run.hpp"
#include "observe/mechanics.hpp"
#include "observe/observed_system.hpp"
#include "support/effect_scenes.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using testing::HasSubstr;

std::string gas(const std::string& more, const std::string& run = "time = 4.0") {
  return "[box]\nx = [0, 10]\ny = [0, 10]\nboundary = \"walls\"\n[[disks]]\nname = \"gas\"\ncount = 24\nradius = 0.4\n"
         "mass = 1\npositions = \"random\"\nvelocities = { temperature = 1 }\n[collision]\nrule = \"specular\"\n[run]\nseed = "
         "3\n" +
         run + "\n" + more;
}

/// One of each kind, at times that are multiples of a power of two and of which two are equal.
const std::string some_changes = R"(
[[changes]]
time = 0.5
set = ["gravity.acceleration=[0, -1]", "collision.restitution=0.9"]
[[changes]]
time = 0.75
set = ["walls.left={ temperature = 2 }", "walls.right={ velocity = -0.25 }"]
[[changes]]
time = 1.25
scale_velocities = -1.0
[[changes]]
time = 1.25
set = ["walls.right={ velocity = 0 }", "thermostat={ temperature = 1, rate = 0.5 }"]
[[changes]]
time = 2.0
add_obstacle = { disk = { centre = [0.02, 0.02], radius = 0.001 } }
[[changes]]
time = 2.5
remove_obstacle = 0
)";

std::string hash_of(const Simulation& simulation) { return state_hash(simulation.state()); }

/// What a program would do in the place of some_changes.
std::string hash_by_hand(const Scene& scene, const std::string& engine) {
  Scene plain = scene;
  plain.changes.clear();
  Simulation simulation = make_simulation(plain, engine);
  const auto change = [&](double time, auto&& edit) {
    simulation.run_until(time);
    Effects effects = simulation.scene().effects;
    edit(effects);
    simulation.set_effects(effects);
  };
  change(0.5, [](Effects& e) {
    e.gravity = Gravity{{0.0, -1.0}};
    e.collision.restitution = 0.9;
  });
  change(0.75, [](Effects& e) {
    e.walls[0].temperature = 2.0;
    e.walls[1].velocity = -0.25;
  });
  simulation.run_until(1.25);
  simulation.set_velocities(-1.0 * simulation.state().velocities);
  change(1.25, [](Effects& e) {
    e.walls[1].velocity = 0.0;
    e.thermostat = Thermostat{1.0, 0.5};
  });
  change(2.0, [](Effects& e) { e.obstacles = {DiskObstacle{{0.02, 0.02}, 0.001}}; });
  change(2.5, [](Effects& e) { e.obstacles.clear(); });
  simulation.run_until(4.0);
  return hash_of(simulation);
}

TEST(SceneChanges, AreWhatAProgramWouldDo) {
  const Scene scene = parse_scene(gas(some_changes));
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(scene, engine);
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::time);
    EXPECT_EQ(hash_of(simulation), hash_by_hand(scene, engine)) << engine;
    EXPECT_TRUE(simulation.scene().changes.empty());
    EXPECT_EQ(simulation.whole_scene().changes.size(), 6U);
    EXPECT_EQ(simulation.scene().box.upper.x(), 9.875) << "the wall that has stopped";
  }
}

TEST(SceneChanges, DoNotDependOnTheCallerAndItsPauses) {
  const Scene scene = parse_scene(gas(some_changes));
  for (const char* engine : engines_with_effects) {
    const std::string twin = hash_by_hand(scene, engine);
    Simulation paused = make_simulation(scene, engine);
    for (int k = 1; k <= 40; ++k) paused.run_until(0.1 * k);
    EXPECT_EQ(hash_of(paused), twin) << engine << ", run_until()";
    Simulation stepped = make_simulation(scene, engine);
    while (stepped.time() < 4.0) (void)stepped.step(4.0);
    EXPECT_EQ(hash_of(stepped), twin) << engine << ", step()";
    Simulation sampled = make_simulation(scene, engine);
    (void)sampled.run_sampled(4.0, {.step = 0.25, .sample = [](std::uint64_t, const State&, const Totals&) {}});
    EXPECT_EQ(hash_of(sampled), twin) << engine << ", run_sampled()";
  }
  LiveRun live(scene);
  for (const double time : {0.1, 0.75, 1.25, 3.0, 4.0}) live.run_until(time);
  EXPECT_EQ(live.hash(), hash_by_hand(scene, "general")) << "the playground";
}

TEST(SceneChanges, TheListForTheProgramDoesTheSame) {
  Scene plain = parse_scene(gas(some_changes));
  const std::vector<Change> list = plain.changes;
  plain.changes.clear();
  LiveRun run(plain);
  for (const Change& change : list) run.apply(change);
  run.run_until(4.0);
  EXPECT_EQ(run.hash(), hash_by_hand(plain, "general"));
}

TEST(SceneChanges, AreResumedAmidThem) {
  const std::string text = gas(some_changes + "[observe]\ntemperature = { every = 0.125 }\nwall_fluxes = { every = 0.125 }\n");
  const Scene scene = parse_scene(text);
  const auto observe = [](Simulation& simulation, RunHooks& hooks, std::istream* saved) {
    auto observation =
        saved != nullptr ? std::make_unique<Observation>(simulation, *saved) : std::make_unique<Observation>(simulation);
    observation->attach(hooks);
    return observation;
  };
  Simulation whole = make_simulation(scene);
  RunHooks hooks;
  const auto observed = observe(whole, hooks, nullptr);
  (void)run_schedule(whole, hooks);
  for (const double until : {0.3, 0.6, 1.3, 2.2, 3.0}) {
    Simulation first = make_simulation(scene);
    std::string simulation_bytes, schedule, observables;
    RunHooks stopping;
    const auto before = observe(first, stopping, nullptr);
    stopping.sample = {};
    stopping.stop_when = [&](const Event& event) { return event.time > until; };
    stopping.checkpoint = [&](const SavingMoment& moment) {
      if (!moment.ended) return;
      std::ostringstream a, b, c;
      first.save(a);
      moment.save(b);
      before->save(c);
      simulation_bytes = a.str(), schedule = b.str(), observables = c.str();
    };
    EXPECT_EQ(run_schedule(first, stopping).stopped, StopReason::condition);
    std::istringstream a(simulation_bytes), b(schedule), c(observables);
    Simulation second = restore_simulation(scene, a);
    RunHooks resuming;
    const auto after = observe(second, resuming, &c);
    resuming.resume = &b;
    (void)run_schedule(second, resuming);
    EXPECT_EQ(hash_of(second), hash_of(whole)) << "saved at " << until;
    EXPECT_EQ(second.whole_scene().changes.size(), 6U);
    const std::vector<Measurement> one = observed->results(), other = after->results();
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t k = 0; k < one.size(); ++k)
      for (std::size_t s = 0; s < one[k].scalars.size(); ++s)
        EXPECT_EQ(one[k].scalars[s].value, other[k].scalars[s].value) << one[k].scalars[s].name << ", saved at " << until;
  }
}

TEST(SceneChanges, AreMadeOnThreadsToTheSameBits) {
  const std::string changes =
      "[[changes]]\ntime = 0.5\nset = [\"gravity.acceleration=[0, -1]\"]\n"
      "[[changes]]\ntime = 1.0\nset = [\"thermostat={ temperature = 1, rate = 0.5 }\"]\n"
      "[[changes]]\ntime = 1.5\nset = [\"thermostat.rate=0\"]\n[[changes]]\ntime = 1.75\nscale_velocities = 0.5\n";
  Scene scene = parse_scene(gas(changes, "time = 2.5"));
  scene.box.upper = {60.0, 60.0};
  scene.species[0].count = 600;
  Simulation alone = make_simulation(scene);
  (void)run_schedule(alone);
  Simulation shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 4});
  (void)run_schedule(shared);
  EXPECT_EQ(hash_of(shared), hash_of(alone));
}

TEST(SceneChanges, SamplesOfThatTimeComeBefore) {
  const Scene scene = parse_scene(gas("[[changes]]\ntime = 1.0\nscale_velocities = -1.0\n", "time = 2.0\nsample_every = 0.5"));
  Simulation simulation = make_simulation(scene);
  std::vector<State> samples;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t, const State& state) { samples.push_back(state); };
  (void)run_schedule(simulation, hooks);
  ASSERT_EQ(samples.size(), 5U);
  EXPECT_LT((samples[4].positions - samples[0].positions).cwiseAbs().maxCoeff(), 1e-8) << "the way back";
  EXPECT_LT((samples[3].velocities + samples[1].velocities).cwiseAbs().maxCoeff(), 1e-8);
  Scene plain = scene;
  plain.changes.clear();
  Simulation twin = make_simulation(plain);
  twin.run_until(1.0);
  EXPECT_EQ(samples[2].velocities, twin.state().velocities) << "of time 1, not yet reversed";
}

TEST(SceneChanges, SamplesOfThatTimeToRoundingComeBefore) {
  // 3 * 0.1 and 7 * 0.1 are later than 0.3 and 0.7 by their rounding, 5 * 0.1 is 0.5 and yet later as a product without rounding.
  for (const int k : {3, 5, 7}) {
    const Scene scene = parse_scene(gas(fmt::format("[[changes]]\ntime = 0.{}\nscale_velocities = 2.0\n", k),
                                        "time = 1.0\nsample_every = 0.1\n[observe]\ntemperature = { every = 0.1 }"));
    const auto doubled_after = [&](const auto& run) {
      Simulation simulation = make_simulation(scene);
      const double begun = energy_of(simulation);
      int before = 0;
      run(simulation, [&](const State& state) { before += kinetic_energy(simulation.disks(), state) < 2.0 * begun ? 1 : 0; });
      return before - 1;
    };
    EXPECT_EQ(doubled_after([](Simulation& simulation, const auto& look) {
                RunHooks hooks;
                hooks.sample = [&](std::uint64_t, const State& state) { look(state); };
                (void)run_schedule(simulation, hooks);
              }),
              k);
    EXPECT_EQ(doubled_after([](Simulation& simulation, const auto& look) {
                simulation.run_sampled(
                    1.0, {.step = 0.1, .sample = [&](std::uint64_t, const State& state, const Totals&) { look(state); }});
              }),
              k);
    EXPECT_EQ(doubled_after([](Simulation& simulation, const auto& look) {
                for (std::uint64_t n = 0; n <= 10; ++n) simulation.run_until_sample(n, 0.1), look(simulation.state());
              }),
              k);
    EXPECT_EQ(doubled_after([](Simulation& simulation, const auto& look) {
                Observation observation(simulation);
                for (int n = 0; n <= 10; ++n) {
                  simulation.run_until(observation.next_sample());
                  observation.sample(simulation);
                  look(simulation.state());
                }
              }),
              k);
  }
}

TEST(SceneChanges, AnObservationWithoutStepsIsNeverDue) {
  Simulation simulation = make_simulation(parse_scene(gas(some_changes)));
  Observation observation(simulation);
  observation.sample(simulation);
  EXPECT_EQ(observation.next_sample(), std::numeric_limits<double>::infinity());
}

TEST(SceneChanges, AStretchThatEndsWithThemLeavesThemToCome) {
  const Scene scene = parse_scene(gas("[[changes]]\ntime = 0.3\nscale_velocities = 2.0\n"));
  Simulation simulation = make_simulation(scene);
  simulation.run_sampled(0.3, {.step = 0.1, .sample = {}});
  EXPECT_EQ(simulation.time(), 0.3);
  EXPECT_EQ(simulation.scene().changes.size(), 1U);
}

TEST(SceneChanges, AnEndThatIsNoTimeMakesNone) {
  Simulation simulation = make_simulation(parse_scene(gas(some_changes)));
  EXPECT_THROW(simulation.run_until(std::numeric_limits<double>::infinity()), std::invalid_argument);
  EXPECT_EQ(simulation.time(), 0.0);
  EXPECT_EQ(simulation.scene().changes.size(), 6U);
}

TEST(SceneChanges, TheWholeRunKnowsWhatAProgramHasSet) {
  Simulation simulation = make_simulation(parse_scene(gas("[[changes]]\ntime = 3.0\nset = [\"collision.restitution=0.5\"]\n")));
  EXPECT_TRUE(simulation.supports_collision_records());
  Effects effects = simulation.scene().effects;
  effects.gravity = Gravity{{0.0, -1.0}};
  simulation.set_effects(effects);
  EXPECT_FALSE(simulation.supports_collision_records()) << "paths bend";
  EXPECT_TRUE(simulation.whole_scene().effects.gravity);
  EXPECT_TRUE(simulation.whole_scene().effects.collision.restitution) << "which is to come";
}

TEST(SceneChanges, CollisionRecordsAreNotToBeHadWhereAChangeLetsVelocitiesChangeInFlight) {
  for (const char* key : {"drag.rate=0.1", "thermostat={ temperature = 1.0, rate = 0.5 }", "growth.rate=0.01"})
    EXPECT_FALSE(make_simulation(parse_scene(gas(fmt::format("[[changes]]\ntime = 3.0\nset = [\"{}\"]\n", key))))
                     .supports_collision_records())
        << key;
}

TEST(SceneChanges, KeysOfTheStartAreRefusedHoweverTheyAreWritten) {
  for (const char* key : {" box.x=[0, 5]", "disks=[]", " disks.0.radius = 0.1", "\\trun.time=1", "title =3"})
    EXPECT_THROW(parse_scene(gas(fmt::format("[[changes]]\ntime = 1.0\nset = [\"{}\"]\n", key))), SceneError) << key;
}

TEST(SceneChanges, APartitionHoldsTheGasUntilItVanishes) {
  const std::string half =
      "[box]\nx = [0, 20]\ny = [0, 10]\nboundary = \"walls\"\n[[disks]]\ncount = 40\nradius = 0.3\nmass = 1\n"
      "positions = { random = { x = [0, 10], y = [0, 10] } }\nvelocities = { temperature = 1 }\n[collision]\nrule = "
      "\"specular\"\n"
      "[[obstacles]]\nsegment = { from = [10, 0], to = [10, 10] }\n[run]\ntime = 60\n"
      "[[changes]]\ntime = 10.0\nremove_obstacle = 0\n";
  Simulation simulation = make_simulation(parse_scene(half));
  const auto on_the_right = [&] { return (simulation.state().positions.row(0).array() > 10.0).count(); };
  EXPECT_EQ(on_the_right(), 0);
  simulation.run_until(10.0);
  EXPECT_EQ(on_the_right(), 0);
  simulation.run_until(60.0);
  EXPECT_GT(on_the_right(), 8);
}

TEST(SceneChanges, LeaveACircularBoxAsItIs) {
  const std::string round =
      "[box]\ncircle = { centre = [0, 0], radius = 5 }\n[[disks]]\ncount = 12\nradius = 0.4\nmass = 1\n"
      "positions = \"random\"\nvelocities = { temperature = 1 }\n[collision]\nrule = \"specular\"\n[run]\ntime = 20\n";
  const Scene scene = parse_scene(round + "[[changes]]\ntime = 1.0\nset = [\"gravity.acceleration=[0, -1]\"]\n" +
                                  "[[changes]]\ntime = 2.0\nadd_obstacle = { arc = { centre = [0, 0], radius = 0.001, from = "
                                  "0, to = 180 } }\n");
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(scene, engine);
    const RunResult result = run_schedule(simulation);
    ASSERT_EQ(result.stopped, StopReason::time);
    EXPECT_LE(simulation.state().positions.colwise().norm().maxCoeff(), 4.6 * (1.0 + 1e-12)) << engine;
    Simulation by_hand = make_simulation(parse_scene(round), engine);
    by_hand.run_until(1.0);
    Effects effects = by_hand.scene().effects;
    effects.gravity = Gravity{{0.0, -1.0}};
    by_hand.set_effects(effects);
    by_hand.run_until(2.0);
    effects.obstacles = {ArcObstacle{{0.0, 0.0}, 0.001, 0.0, 180.0}};
    by_hand.set_effects(effects);
    by_hand.run_until(20.0);
    EXPECT_EQ(hash_of(simulation), hash_of(by_hand)) << engine;
  }
  Simulation before = make_simulation(scene);
  before.run_until(3.0);
  std::stringstream saved;
  before.save(saved);
  Simulation restored = restore_simulation(scene, saved);
  restored.run_until(20.0);
  LiveRun live(scene);
  live.run_until(20.0);
  Simulation direct = make_simulation(scene);
  direct.run_until(20.0);
  EXPECT_EQ(live.hash(), hash_of(direct));
  EXPECT_EQ(hash_of(restored), hash_of(direct));
}

TEST(SceneChanges, ThatDisksBlockEndTheRunWithWhatItHas) {
  const Scene scene = parse_scene(gas("[[changes]]\ntime = 1.5\nadd_obstacle = { disk = { centre = [5, 5], radius = 4.5 } }\n",
                                      "time = 3.0\nsample_every = 0.5"));
  Simulation simulation = make_simulation(scene);
  std::size_t samples = 0;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t, const State&) { ++samples; };
  const RunResult result = run_schedule(simulation, hooks);
  EXPECT_EQ(result.stopped, StopReason::blocked);
  EXPECT_EQ(to_string(result.stopped), "blocked");
  EXPECT_THAT(result.blocked_by, HasSubstr("the change of time 1.5 cannot be made: disk"));
  EXPECT_THAT(result.blocked_by, HasSubstr("overlaps obstacles.0"));
  EXPECT_EQ(samples, 4U);
  EXPECT_EQ(simulation.time(), 1.5);
  Simulation by_hand = make_simulation(scene);
  EXPECT_THAT(refusal<SceneError>([&] { by_hand.run_until(3.0); }), HasSubstr("cannot be made"));
  EXPECT_EQ(by_hand.time(), 1.5);
}

TEST(SceneChanges, CountFromTheEndOfEquilibrating) {
  const Scene scene = parse_scene(
      gas("[[changes]]\ntime = 0.5\nset = [\"gravity.acceleration=[0, -1]\"]\n", "time = 1.0\nequilibrate = { time = 2.0 }"));
  Simulation simulation = make_simulation(scene);
  (void)run_schedule(simulation);
  Scene plain = scene;
  plain.changes.clear();
  Simulation twin = make_simulation(plain);
  twin.run_until(2.0);
  twin.reset_clock();
  twin.run_until(0.5);
  Effects effects = plain.effects;
  effects.gravity = Gravity{{0.0, -1.0}};
  twin.set_effects(effects);
  twin.run_until(1.0);
  EXPECT_EQ(hash_of(simulation), hash_of(twin));
  Simulation by_hand = make_simulation(scene);
  by_hand.run_until(2.0);
  EXPECT_EQ(by_hand.scene().changes.size(), 1U);
  by_hand.reset_clock();
  by_hand.run_until(1.0);
  EXPECT_EQ(hash_of(by_hand), hash_of(twin));
}

TEST(SceneChanges, ARunThatOnlyCollisionsEndWaitsForThem) {
  const std::string still =
      "[box]\nx = [0, 10]\ny = [0, 10]\nboundary = \"walls\"\n[[disks]]\nradius = 0.5\nmass = 1\n"
      "positions = [[5, 2], [5, 6]]\nvelocities = \"rest\"\n[collision]\nrule = \"specular\"\n[run]\ncollisions = 1\n"
      "[[changes]]\ntime = 3.0\nset = [\"gravity.acceleration=[0, -1]\"]\n";
  Simulation simulation = make_simulation(parse_scene(still));
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::collisions);
  EXPECT_GT(simulation.time(), 3.0);
}

/// The other effect begins with a wait of its own, and draws its own numbers.
TEST(SceneChanges, RedrawsOfSeveralKindsTakeTurns) {
  const std::string text =
      "[box]\nx = [0, 10]\ny = [0, 10]\nboundary = \"periodic\"\n[[disks]]\ncount = 20\nradius = 0.3\nmass = 1\n"
      "positions = \"random\"\nvelocities = { temperature = 1 }\n[collision]\nrule = \"specular\"\n[run]\ntime = 6\n"
      "[thermostat]\ntemperature = 1\nrate = 1\n"
      "[[changes]]\ntime = 2.0\nset = [\"thermostat.rate=0\", \"tumbling.rate=1\"]\n"
      "[[changes]]\ntime = 4.0\nset = [\"tumbling.rate=0\", \"brownian={ temperature = 1, rate = 1 }\"]\n";
  Simulation simulation = make_simulation(parse_scene(text));
  simulation.run_until(2.0);
  const std::uint64_t by_the_bath = simulation.counts().thermostat;
  const double energy_at_2 = simulation.state().velocities.squaredNorm();
  simulation.run_until(4.0);
  EXPECT_NEAR(simulation.state().velocities.squaredNorm(), energy_at_2, 1e-10) << "tumbles and collisions keep the energy";
  const std::uint64_t tumbles = simulation.counts().thermostat - by_the_bath;
  EXPECT_NEAR(static_cast<double>(tumbles), 40.0, 5.0 * std::sqrt(40.0));
  simulation.run_until(6.0);
  EXPECT_EQ(simulation.counts().thermostat - by_the_bath - tumbles, 2U * 20U);
}

TEST(SceneChanges, AreNotForFixedSteps) {
  const Scene scene = parse_scene(gas("[[changes]]\ntime = 0.5\nscale_velocities = 2.0\n"));
  EXPECT_THROW((void)make_simulation(scene, FixedStep{"grid", 0.01}), std::invalid_argument);
}

/// Coordinates of another engine have room for the box and some spacings beyond; walls may have moved much farther.
TEST(SceneChanges, LeaveDisksWhereTheyAreFarOutsideTheBox) {
  for (const char* wall : {"right", "left"}) {
    const double way = *wall == 'r' ? 1.0 : -1.0;
    const Scene scene = parse_scene(fmt::format(
        "[box]\nx = [0, 1]\ny = [0, 1]\nboundary = \"walls\"\n[[disks]]\nradius = 0.125\nmass = 1\npositions = [[0.5, 0.25]]\n"
        "velocities = [[{}, 0]]\n[collision]\nrule = \"specular\"\n[walls]\n{} = {{ velocity = {} }}\n[run]\ntime = 1e6\n"
        "[[changes]]\ntime = 100\nscale_velocities = 1.0\n[[changes]]\ntime = 1000\nscale_velocities = 1.0\n",
        way, wall, way));
    for (const char* engine : {"general", "textbook"}) {
      Simulation simulation = make_simulation(scene, engine);
      for (const double time : {99.0, 128.0, 1024.0, 1e6}) {
        simulation.run_until(time);
        EXPECT_EQ(simulation.state().positions(0, 0), 0.5 + way * time) << engine << " with the wall " << wall;
      }
    }
  }
}

TEST(SceneChanges, KeepDisksApartFarOutsideTheBox) {
  const std::string wells = "[[changes]]\ntime = 500\nset = [\"square_well={ width = 1.5, depth = 0.1 }\"]\n";
  const std::string nothing = "[[changes]]\ntime = 500\nscale_velocities = 1.0\n";
  for (const std::string right :
       {"{ velocity = 1.0 }", "{ mass = 10.0, load = 0.001 }", "{ velocity = 1.0 }\nleft = { velocity = -1.0 }"})
    for (const std::string& change : {nothing, wells}) {
      SCOPED_TRACE(right + change);
      const Scene scene = parse_scene(
          "[box]\nx = [0, 14]\ny = [0, 14]\nboundary = \"walls\"\n[[disks]]\ncount = 25\nradius = 0.5\nmass = 1\npositions = "
          "\"random\"\nvelocities = { temperature = 1 }\n[collision]\nrule = \"specular\"\n[walls]\nright = " +
          right + "\n[run]\ntime = 600\n" + change);
      Simulation simulation = make_simulation(scene);
      EXPECT_EQ(simulation.run_until(600.0), StopReason::time);
      EXPECT_EQ(simulation.check_invariants(), std::vector<std::string>());
      EXPECT_EQ(simulation.totals().numerics.overlapping, 0U);
      EXPECT_GT(simulation.state().walls[1].position, 100.0) << "where disks are beyond the room";
    }
}

/// Rough disks that a change makes smooth keep their spins, whatever engine that lets run them.
TEST(SceneChanges, KeepSpinsWhereDisksBecomeSmooth) {
  const Scene scene = parse_scene(
      "[box]\nx = [0, 10]\ny = [0, 10]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.5\nmass = 1\npositions = [[2, 5], [5, "
      "5.4]]\nvelocities = [[1, 0], [-1, 0]]\n[collision]\nrule = \"specular\"\nroughness = 1.0\n[run]\ntime = 14\n"
      "[[changes]]\ntime = 3\nset = [\"collision.roughness=-1\"]\n[[changes]]\ntime = 4\nset = [\"collision.roughness=1\"]\n");
  Simulation simulation = make_simulation(scene), textbook = make_simulation(scene, "textbook");
  for (const double time : {3.0, 3.5, 14.0}) {
    simulation.run_until(time);
    textbook.run_until(time);
    ASSERT_EQ(simulation.state().spins.size(), 2) << time;
    EXPECT_GT(simulation.state().spins.cwiseAbs().minCoeff(), 0.5) << time;
    EXPECT_TRUE(simulation.state().spins.isApprox(textbook.state().spins, 1e-12)) << time;
  }
}

/// Where images slide, a pair that a change lets overlap is not seen by the scene that begins there.
TEST(SceneChanges, AreRefusedWhereDisksOfAShearedBoxAreInTheWay) {
  const auto scene = [](const std::string& rate) {
    return parse_scene(
        "[box]\nx = [0, 10]\ny = [0, 10]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.5\nmass = 1\npositions = [[2, 5]]\n"
        "velocities = [[0, 0]]\n[[disks]]\nradius = 0.5\nmass = 1\npositions = [[3.1, 5]]\nvelocities = [[0, 0]]\n[collision]\n"
        "rule = \"specular\"\n[shear]\nrate = " +
        rate + "\n[run]\ntime = 3\n[[changes]]\ntime = 1\nset = [\"non_additivity.delta=0.5\"]\n");
  };
  for (const char* rate : {"0.1", "-0.1", "0.0"}) {
    for (const char* engine : {"general", "textbook"}) {  // by no check of their own: textbook compares few disks only
      Simulation simulation = make_simulation(scene(rate), engine);
      RunHooks hooks;
      const RunResult result = run_schedule(simulation, hooks);
      EXPECT_EQ(result.stopped, StopReason::blocked) << rate;
      EXPECT_EQ(simulation.time(), 1.0) << rate;
      EXPECT_THAT(result.blocked_by, HasSubstr("disks 0 and 1 overlap by 0.4; their centres must be at least 1.5 apart")) << rate;
    }
  }
  Simulation simulation = make_simulation(scene("0.1"));
  simulation.run_until(0.5);
  Effects effects = simulation.scene().effects;
  effects.non_additivity = NonAdditivity{0.5};
  const std::string before = hash_of(simulation);
  EXPECT_THROW(simulation.set_effects(effects), SceneError);
  EXPECT_EQ(hash_of(simulation), before);
}

/// What a program asks for has to fit changes to come; where it does not, nothing has changed.
TEST(SceneChanges, ToComeThatDoNotFitLeaveTheSimulationAsItWas) {
  const Scene scene =
      parse_scene(gas("[thermostat]\ntemperature = 1\nrate = 5\n[[changes]]\ntime = 2\nset = [\"thermostat.rate=0\"]\n"));
  Simulation simulation = make_simulation(scene), twin = make_simulation(scene);
  Effects effects = scene.effects;
  effects.thermostat.reset();
  EXPECT_THROW(simulation.set_effects(effects), SceneError);
  EXPECT_TRUE(simulation.scene().effects.thermostat.has_value());
  simulation.run_until(1.0);
  twin.run_until(1.0);
  EXPECT_EQ(hash_of(simulation), hash_of(twin));
}

/// Observables have the radii that began and a scale, as files have, also where a change has ended the growth.
TEST(SceneChanges, ThatEndGrowthLeaveObservablesTheScaleThatIs) {
  Simulation simulation = make_simulation(parse_scene(
      "[box]\nx = [0, 10]\ny = [0, 10]\nboundary = \"walls\"\n[[disks]]\nradius = 0.5\nmass = 1\npositions = [[2, 5]]\n"
      "velocities = [[1, 0]]\n[collision]\nrule = \"specular\"\n[growth]\nrate = 0.1\n[run]\ntime = 4\n"
      "[[changes]]\ntime = 2\nset = [\"growth.rate=0\"]\n"));
  Observation observation(simulation);
  Record record;
  observation.add(std::make_unique<Recorder>(1.0, record));
  RunHooks hooks;
  observation.attach(hooks);
  run_schedule(simulation, hooks);
  std::vector<double> scales;
  for (const State& state : record.states) scales.push_back(state.scale);
  EXPECT_THAT(scales, testing::Pointwise(testing::DoubleNear(1e-14), {1.0, 1.1, 1.2, 1.2, 1.2}));
}

/// Observables have the box that began: a wall that a change has stopped stands where it is, as one that hardly moves does.
TEST(SceneChanges, ThatStopTheLastWallLeaveObservablesTheBoxThatIs) {
  const auto measured = [](const std::string& speed) {
    const Scene scene = parse_scene(
        "[box]\nx = [0, 10]\ny = [0, 10]\nboundary = \"walls\"\n[[disks]]\nradius = 0.5\nmass = 1\npositions = [[2, 5], [2, 8]]\n"
        "velocities = [[1, 0], [1, 0]]\n[collision]\nrule = \"specular\"\n[walls]\ntop = { velocity = 10.0 }\n[run]\ntime = 101\n"
        "[observe]\npressure = { every = 0.5 }\nwall_fluxes = { every = 0.5 }\n[[changes]]\ntime = 1\nset = "
        "[\"walls.top.velocity=" +
        speed + "\"]\n");
    return observe(scene, 101.0).measurements;
  };
  const std::vector<Measurement> stopped = measured("0"), slow = measured("1e-13");
  ASSERT_EQ(stopped.size(), slow.size());
  for (std::size_t m = 0; m < slow.size(); ++m) {
    ASSERT_EQ(stopped[m].scalars.size(), slow[m].scalars.size());
    for (std::size_t s = 0; s < slow[m].scalars.size(); ++s)
      if (const auto& value = slow[m].scalars[s].value) {
        EXPECT_NEAR(stopped[m].scalars[s].value.value(), *value, 1e-9) << slow[m].scalars[s].name;
      }
  }
}

}  // namespace
}  // namespace carom::test
