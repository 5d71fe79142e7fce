// Records of collisions that the engine keeps itself, against those that the event log and a copy of all velocities give: the
// same bits.

#include "observe/collision_stream.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

void expect_same(const std::vector<PairCollision>& told, const std::vector<PairCollision>& followed) {
  ASSERT_EQ(told.size(), followed.size());
  for (std::size_t n = 0; n < told.size(); ++n) {
    const PairCollision &a = told[n], &b = followed[n];
    ASSERT_EQ(a.time, b.time) << n;
    ASSERT_EQ(a.disk, b.disk) << n;
    ASSERT_EQ(a.partner, b.partner) << n;
    ASSERT_EQ(a.separation, b.separation) << n;
    ASSERT_EQ(a.impulse, b.impulse) << n;
    ASSERT_EQ(a.velocity_before, b.velocity_before) << n;
    ASSERT_EQ(a.velocity, b.velocity) << n;
    ASSERT_EQ(a.partner_velocity_before, b.partner_velocity_before) << n;
    ASSERT_EQ(a.partner_velocity, b.partner_velocity) << n;
    ASSERT_EQ(a.contact, b.contact) << n;
  }
}

std::vector<Scene> scenes_that_tell() {
  std::vector<Scene> scenes = {gas_scene(100, 0.5, Boundary::periodic), gas_scene(100, 0.5, Boundary::walls),
                               mixture_scene(100, 0.4, Boundary::periodic), mixture_scene(100, 0.4, Boundary::walls)};
  scenes.push_back(gas_scene(100, 0.3, Boundary::periodic));
  scenes.back().effects.collision.restitution = 0.95;
  scenes.push_back(gas_scene(100, 0.3, Boundary::walls));
  scenes.back().effects.walls[0].temperature = 2.0;
  for (Scene& scene : scenes) {
    scene.run.time.reset();
    scene.run.collisions = 3'000;
    scene.run.equilibrate = Run::Equilibrate{3.0, {}};
  }
  return scenes;
}

TEST(CollisionRecordsOfRuns, AreThoseOfTheEventLog) {
  for (const Scene& scene : scenes_that_tell()) {
    Simulation simulation = make_simulation(scene);
    ASSERT_TRUE(simulation.supports_collision_records());
    std::optional<CollisionStream> stream;
    std::vector<PairCollision> told, followed, some;
    RunHooks hooks;
    hooks.start = [&](const State& state) { stream.emplace(observed_run(simulation)).start(state); };
    hooks.events = [&](std::span<const Event> events) {
      stream->follow(events).read(some);
      followed.insert(followed.end(), some.begin(), some.end());
    };
    hooks.collisions = [&](const CollisionRecords& records) {
      records.read(some);
      told.insert(told.end(), some.begin(), some.end());
    };
    run_schedule(simulation, hooks);
    EXPECT_EQ(told.size(), 3'000U);
    expect_same(told, followed);
  }
}

TEST(CollisionRecordsOfRuns, ListeningDoesNotChangeTheRun) {
  const Scene scene = scenes_that_tell()[3];
  const auto end_of = [&](bool listens) {
    Simulation simulation = make_simulation(scene);
    RunHooks hooks;
    if (listens) hooks.collisions = [](const CollisionRecords&) {};
    run_schedule(simulation, hooks);
    return simulation.state();
  };
  const State heard = end_of(true), unheard = end_of(false);
  EXPECT_EQ(heard.positions, unheard.positions);
  EXPECT_EQ(heard.velocities, unheard.velocities);
}

TEST(CollisionRecordsOfRuns, AllUpToASampleComeBeforeIt) {
  Scene scene = gas_scene(30, 0.5, Boundary::periodic);
  scene.run.time = 5.0;
  scene.run.sample_every = 0.25;
  Simulation simulation = make_simulation(scene);
  std::uint64_t told = 0;
  RunHooks hooks;
  hooks.collisions = [&](const CollisionRecords& records) { told += records.records.size(); };
  hooks.sample = [&](std::uint64_t, const State&) { EXPECT_EQ(told, simulation.totals().pair); };
  run_schedule(simulation, hooks);
  EXPECT_EQ(told, simulation.totals().pair);
  EXPECT_GT(told, 100U);
}

TEST(CollisionRecordsOfRuns, CanBeReadLater) {
  Scene scene = gas_scene(40, 0.5, Boundary::periodic);
  scene.run.collisions = 500;
  std::vector<PairCollision> at_once, later, some;
  std::vector<std::vector<CollisionRecord>> kept;
  std::vector<CollisionRecords> heard;
  {
    Simulation simulation = make_simulation(scene);
    RunHooks hooks;
    hooks.collisions = [&](const CollisionRecords& records) {
      records.read(some);
      at_once.insert(at_once.end(), some.begin(), some.end());
      kept.emplace_back(records.records.begin(), records.records.end());
      heard.push_back(records);
      heard.back().records = kept.back();
    };
    run_schedule(simulation, hooks);
  }
  for (const CollisionRecords& records : heard) {
    records.read(some);
    later.insert(later.end(), some.begin(), some.end());
  }
  expect_same(later, at_once);
}

TEST(CollisionRecordsOfRuns, AreWrittenWhereTheListenerWantsThem) {
  Scene scene = gas_scene(40, 0.5, Boundary::periodic);
  scene.run.collisions = 500;
  std::vector<CollisionRecord> in_order(500), some(7);
  std::size_t kept = 0, elsewhere = 0;
  std::span<CollisionRecord> given;
  const auto listen = [&](auto room) {
    Simulation simulation = make_simulation(scene);
    RunHooks hooks;
    std::vector<PairCollision> heard, part;
    hooks.collisions = [&](const CollisionRecords& records) {
      elsewhere += records.records.data() != given.data() ? 1U : 0U;
      EXPECT_TRUE(given.empty() || records.records.size() <= given.size());
      kept += records.records.size();
      records.read(part);
      heard.insert(heard.end(), part.begin(), part.end());
    };
    if (room) hooks.room_for_records = room;
    run_schedule(simulation, hooks);
    return heard;
  };
  using Room = std::function<std::span<CollisionRecord>()>;
  const std::vector<PairCollision> copied = listen(Room());
  EXPECT_GT(elsewhere, 0U);
  for (const bool all : {true, false}) {
    kept = elsewhere = 0;
    const Room room = [&] { return given = all ? std::span(in_order).subspan(kept) : std::span(some); };
    expect_same(listen(room), copied);
    EXPECT_EQ(elsewhere, 0U);
  }
  EXPECT_LT(in_order[0].time, in_order[1].time) << "the records are still there";
  given = {};
  expect_same(listen(Room([] { return std::span<CollisionRecord>(); })), copied);
}

TEST(CollisionRecordsOfRuns, BelongToTheListenerOnceTheyAreTold) {
  Scene scene = gas_scene(40, 0.5, Boundary::periodic);
  scene.run.collisions = 500;
  const auto log_of = [&](RunHooks hooks) {
    std::vector<Event> log;
    hooks.events = [&](std::span<const Event> events) { log.insert(log.end(), events.begin(), events.end()); };
    Simulation simulation = make_simulation(scene);
    run_schedule(simulation, hooks);
    return log;
  };
  std::vector<CollisionRecord> room(100);
  RunHooks hooks;
  hooks.collisions = [&](const CollisionRecords&) { room.assign(100, CollisionRecord{-1.0, 7, 7, {}, {}, {}, {}}); };
  hooks.room_for_records = [&] { return std::span(room); };
  const std::vector<Event> log = log_of(hooks), expected = log_of({});
  ASSERT_EQ(log.size(), expected.size());
  for (std::size_t n = 0; n < log.size(); ++n) {
    EXPECT_EQ(log[n].time, expected[n].time);
    EXPECT_EQ(log[n].disk, expected[n].disk);
    EXPECT_EQ(log[n].partner, expected[n].partner);
  }
}

TEST(CollisionRecordsOfRuns, WhatAsksForRoomMayThrow) {
  Scene scene = gas_scene(40, 0.5, Boundary::periodic);
  scene.run.collisions = 1'000;
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  hooks.collisions = [](const CollisionRecords&) { ADD_FAILURE() << "after the first error the hook is not called"; };
  hooks.room_for_records = []() -> std::span<CollisionRecord> { throw std::runtime_error("no room"); };
  EXPECT_THROW(run_schedule(simulation, hooks), std::runtime_error);
  EXPECT_TRUE(simulation.check_invariants().empty());
}

TEST(CollisionRecordsOfRuns, ThereAreNoneWithoutDisks) {
  Scene scene = gas_scene(4, 0.5, Boundary::walls);
  scene.species.front().count = 0;
  scene.run.time = 1.0;
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  hooks.collisions = [](const CollisionRecords&) { FAIL(); };
  EXPECT_EQ(run_schedule(simulation, hooks).stopped, StopReason::time);
}

TEST(CollisionRecordsOfRuns, WhatAListenerThrowsComesOutBetweenTwoEvents) {
  Scene scene = gas_scene(40, 0.5, Boundary::periodic);
  scene.run.collisions = 1'000;
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  int calls = 0;
  hooks.collisions = [&](const CollisionRecords&) {
    ++calls;
    throw std::runtime_error("no more");
  };
  EXPECT_THROW(run_schedule(simulation, hooks), std::runtime_error);
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(simulation.check_invariants().empty());
  simulation.reset_clock();
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::collisions) << "the hook is not called any more";
}

TEST(CollisionRecordsOfRuns, AreNotToBeHadWhereVelocitiesDoNotTellEverything) {
  const auto tells = [](auto change, const std::string& engine = "auto") {
    Scene scene = gas_scene(30, 0.3, Boundary::walls);
    change(scene);
    return make_simulation(scene, engine).supports_collision_records();
  };
  EXPECT_TRUE(tells([](Scene&) {}));
  EXPECT_FALSE(tells([](Scene&) {}, "textbook"));
  EXPECT_TRUE(tells([](Scene& scene) {
    scene.effects.gravity = Gravity{};
    scene.effects.square_well = SquareWell{1.5, 0.0};
    scene.effects.collision.roughness = -1.0;
  })) << "nothing acts";
  EXPECT_FALSE(tells([](Scene& scene) { scene.effects.collision.rule = CollisionRule::reversal; }));
  EXPECT_FALSE(tells([](Scene& scene) { scene.effects.collision.roughness = 0.5; }));
  EXPECT_FALSE(tells([](Scene& scene) { scene.effects.gravity = Gravity{{0.0, -1.0}}; }));
  EXPECT_FALSE(tells([](Scene& scene) { scene.effects.thermostat = Thermostat{1.0, 1.0}; }));
  EXPECT_FALSE(tells([](Scene& scene) { scene.effects.square_well = SquareWell{1.5, 0.1}; }));
  Scene scene = gas_scene(30, 0.3, Boundary::walls);
  scene.run.collisions = 10;
  Simulation textbook = make_simulation(scene, "textbook");
  RunHooks hooks;
  hooks.collisions = [](const CollisionRecords&) {};
  EXPECT_THROW(run_schedule(textbook, hooks), std::invalid_argument);
}

}  // namespace
}  // namespace carom::test
