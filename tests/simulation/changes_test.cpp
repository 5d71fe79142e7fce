// What a program changes while a simulation runs. The twin of a change is a simulation that begins in the same state with the
// same setting: both find the same bits, event by event. Time, totals and random streams go on where they were.

#include "scene/effect_traits.hpp"
#include "simulation/twin_event.hpp"
#include "support/effect_scenes.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using testing::HasSubstr;

struct Change {
  std::string name;
  std::function<void(Effects&)> before;  ///< what the scene begins with
  std::function<void(Effects&)> after;   ///< what is changed
  Boundary boundary = Boundary::walls;
};

void PrintTo(const Change& one, std::ostream* out) { *out << one.name; }

void nothing(Effects& /*effects*/) {}

std::vector<Change> changes() {
  const auto gate = [](Effects& e) { e.obstacles = {SegmentObstacle{{3.0, 0.0}, {3.0, 4.0}}}; };
  std::vector<Change> all = {
      {"GravityOn", nothing,
       [](Effects& e) {
         e.gravity = Gravity{{0.0, -1.0}};
       }},
      {"GravityTurned",
       [](Effects& e) {
         e.gravity = Gravity{{0.0, -1.0}};
       },
       [](Effects& e) {
         e.gravity = Gravity{{0.5, 0.25}};
       }},
      {"GravityOff",
       [](Effects& e) {
         e.gravity = Gravity{{0.0, -1.0}};
       },
       [](Effects& e) { e.gravity.reset(); }},
      {"Restitution", nothing, [](Effects& e) { e.collision.restitution = 0.9; }},
      {"RestitutionGone", [](Effects& e) { e.collision.restitution = 0.9; }, [](Effects& e) { e.collision.restitution.reset(); }},
      {"Rule", nothing, [](Effects& e) { e.collision.rule = CollisionRule::reversal; }, Boundary::periodic},
      {"Roughness", nothing, [](Effects& e) { e.collision.roughness = 0.5; }},
      {"RoughnessOther", [](Effects& e) { e.collision.roughness = 0.5; }, [](Effects& e) { e.collision.roughness = 1.0; }},
      {"WallRestitution", nothing, [](Effects& e) { e.walls[2].restitution = 0.5; }},
      {"WallSetInMotion", nothing, [](Effects& e) { e.walls[1].velocity = 0.05; }},
      {"WallTurnedRound", [](Effects& e) { e.walls[1].velocity = 0.2; }, [](Effects& e) { e.walls[1].velocity = -0.1; }},
      {"WallStopped", [](Effects& e) { e.walls[1].velocity = 0.2; }, [](Effects& e) { e.walls[1].velocity = 0.0; }},
      {"WallBeginsToVibrate", nothing,
       [](Effects& e) {
         e.walls[2].oscillation = Oscillation{WaveForm::sine, 0.1, 2.0, 0.25};
       }},
      {"WallVibratesOtherwise",
       [](Effects& e) {
         e.walls[2].oscillation = Oscillation{WaveForm::sine, 0.1, 2.0};
       },
       [](Effects& e) { e.walls[2].oscillation->form = WaveForm::sawtooth; }},
      {"WallStopsVibrating",
       [](Effects& e) {
         e.walls[2].oscillation = Oscillation{WaveForm::sawtooth, 0.1, 2.2};
       },
       [](Effects& e) { e.walls[2].oscillation.reset(); }},
      {"Piston", nothing, [](Effects& e) { e.walls[3] = {.mass = 5.0, .load = 1.0}; }},
      {"PistonLoad", [](Effects& e) { e.walls[3] = {.mass = 5.0, .load = 1.0}; }, [](Effects& e) { e.walls[3].load = 2.0; }},
      {"PistonHeld", [](Effects& e) { e.walls[3] = {.mass = 5.0, .load = 1.0}; }, [](Effects& e) { e.walls[3] = {}; }},
      {"GateOpened", gate, [](Effects& e) { e.obstacles.clear(); }},
      {"GrowthFaster", [](Effects& e) { e.growth = Growth{.rate = 0.01}; }, [](Effects& e) { e.growth->rate = 0.02; }},
      {"GrowthStopped", [](Effects& e) { e.growth = Growth{.rate = 0.01}; }, [](Effects& e) { e.growth.reset(); }},
      {"GrowthBegun", nothing, [](Effects& e) { e.growth = Growth{.rate = 0.01}; }, Boundary::periodic},
      {"Shear", [](Effects& e) { e.shear = Shear{0.1}; }, [](Effects& e) { e.shear->rate = -0.2; }, Boundary::periodic},
      {"WellDepth",
       [](Effects& e) {
         e.square_well = SquareWell{1.3, 0.5};
       },
       [](Effects& e) { e.square_well->depth = 0.25; }},
      {"WellGone",
       [](Effects& e) {
         e.square_well = SquareWell{1.3, 0.5};
       },
       [](Effects& e) { e.square_well.reset(); }},
      {"StepsFlatter",
       [](Effects& e) {
         e.stepped_potential = SteppedPotential{{{1.2, 0.5}, {1.4, -0.5}}};
       },
       [](Effects& e) { e.stepped_potential->steps[0].energy = 0.25; }},
      {"StepsGone",
       [](Effects& e) {
         e.stepped_potential = SteppedPotential{{{1.2, 0.5}, {1.4, -0.5}}};
       },
       [](Effects& e) { e.stepped_potential.reset(); }},
      {"Thermostat", nothing,
       [](Effects& e) {
         e.thermostat = Thermostat{1.0, 0.5};
       }},
      {"ThermalWall", nothing, [](Effects& e) { e.walls[0].temperature = 2.0; }},
  };
  // Whatever is a table of numbers begins and ends.
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    if (effect.numbers.empty()) continue;
    const auto mild = [&effect](Effects& e) { detail::set_numbers(e, effect, &detail::EffectNumber::mild); };
    const auto without = [](Effects& e) { e = Effects{}; };
    all.push_back({std::string(effect.name) + "_on", nothing, mild, Boundary::periodic});
    all.push_back({std::string(effect.name) + "_off", mild, without, Boundary::periodic});
  }
  return all;
}

Scene scene_before(const Change& change) {
  Scene scene = gas_scene(30, 0.2, change.boundary);
  scene.species[0].positions = RandomPositions{};
  change.before(scene.effects);
  return scene;
}

class Changes : public testing::TestWithParam<Change> {};

TEST_P(Changes, FindTheBitsOfASceneThatBeginsSo) {
  for (const char* engine : {"auto", "general", "textbook"}) {
    SCOPED_TRACE(engine);
    Simulation simulation = make_simulation(scene_before(GetParam()), engine);
    simulation.run_until(1.0);
    const Totals before = simulation.totals();
    const State state = simulation.state();
    Effects effects = simulation.scene().effects;
    GetParam().after(effects);
    simulation.set_effects(effects);
    EXPECT_EQ(simulation.time(), 1.0) << "the clock goes on";
    EXPECT_EQ(simulation.totals().virial, before.virial);
    EXPECT_EQ(simulation.counts().events(), before.events());
    EXPECT_THAT(simulation.check_invariants(), testing::IsEmpty());

    Simulation twin = make_simulation(simulation.scene(), simulation.state(), engine);
    EXPECT_EQ(simulation.engine(), twin.engine());
    EXPECT_EQ(simulation.engine_reason(), twin.engine_reason());
    EXPECT_TRUE(same_bits(simulation.state().positions, state.positions));
    EXPECT_TRUE(same_bits(simulation.state().velocities, state.velocities));
    EXPECT_EQ(simulation.state().images, state.images);
    for (int step = 0; step < 200; ++step) {
      const std::optional<Event> event = simulation.step();
      ASSERT_NO_FATAL_FAILURE(expect_twin_event(event, twin.step(), 1.0, step));
    }
    EXPECT_EQ(simulation.counts().pair, before.pair + twin.counts().pair);
    EXPECT_EQ(simulation.counts().wall, before.wall + twin.counts().wall);
    EXPECT_NEAR(simulation.totals().virial, before.virial + twin.totals().virial, 1e-12 * simulation.totals().virial);
    EXPECT_TRUE(same_bits(simulation.state().positions, twin.state().positions));
    EXPECT_EQ(simulation.state().scale, twin.state().scale);
    EXPECT_THAT(simulation.check_invariants(), testing::IsEmpty());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Changes, testing::ValuesIn(changes()), [](const auto& change) { return change.param.name; });

TEST(Changes, GoAsFarAsTheTwinToATimeBetweenEvents) {
  Simulation simulation = make_simulation(gas_scene(30, 0.4, Boundary::walls));
  simulation.run_until(2.0);
  Effects effects = simulation.scene().effects;
  effects.gravity = Gravity{{0.0, -0.5}};
  simulation.set_effects(effects);
  Simulation twin = make_simulation(simulation.scene(), simulation.state());
  simulation.run_until(5.0);
  twin.run_until(3.0);
  EXPECT_EQ(simulation.time(), 5.0);
  EXPECT_TRUE(same_bits(simulation.state().positions, twin.state().positions));
  EXPECT_TRUE(same_bits(simulation.state().velocities, twin.state().velocities));
}

TEST(Changes, ChooseTheEngineAnew) {
  Simulation simulation = make_simulation(gas_scene(16, 0.4, Boundary::walls));
  EXPECT_EQ(simulation.engine(), "fast");
  Effects effects = simulation.scene().effects;
  effects.gravity = Gravity{{0.0, -0.5}};
  simulation.set_effects(effects);
  EXPECT_EQ(simulation.engine(), "general");
  EXPECT_EQ(simulation.engine_reason(), "the scene asks for gravity");
  effects.gravity.reset();
  simulation.set_effects(effects);
  EXPECT_EQ(simulation.engine(), "fast");
  Simulation named = make_simulation(gas_scene(16, 0.4, Boundary::walls), "textbook");
  named.set_effects(effects);
  EXPECT_EQ(named.engine(), "textbook");
}

TEST(Changes, LookForDisksThroughShearedEdgesWhereTheseHaveSlid) {
  // Both move with the flow, one below an edge and one above it, and pass each other where no image is.
  Scene scene = scene_of(
      box_of(8.0, 8.0, Boundary::periodic, Boundary::periodic),
      {species_of(2, 0.5, 1.0, ListedPositions{{{2.0, 7.75}, {6.0, 0.25}}}, ListedVelocities{{{1.875, 0.0}, {-1.875, 0.0}}})});
  scene.effects.shear = Shear{0.5};
  Simulation simulation = make_simulation(scene);
  simulation.run_until(1.0);
  Effects effects = scene.effects;
  effects.collision.restitution = 0.9;
  EXPECT_NO_THROW(simulation.set_effects(effects));
  effects.shear.reset();
  EXPECT_THROW(simulation.set_effects(effects), SceneError) << "without the shear they do overlap";
}

/// One disk between two walls that draw its speed, and nothing else to meet.
Scene between_thermal_walls(double temperature) {
  Scene scene = scene_of(box_of(2.0, 8.0, Boundary::walls, Boundary::periodic),
                         {species_of(1, 0.5, 1.0, ListedPositions{{{1.0, 4.0}}}, ListedVelocities{{{1.0, 0.0}}})});
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) scene.effects.walls[k].temperature = temperature;
  return scene;
}

TEST(Changes, GoOnInTheStreamOfThermalWalls) {
  for (const char* engine : engines_with_effects) {
    Simulation plain = make_simulation(between_thermal_walls(1.0), engine);
    Simulation changed = make_simulation(between_thermal_walls(1.0), engine);
    for (int k = 0; k < 30; ++k) {
      const std::optional<Event> cool = plain.step(), hot = changed.step();
      ASSERT_EQ(cool->partner, hot->partner);
      ASSERT_EQ(hot->velocity, (k < 10 ? 1.0 : 2.0) * cool->velocity) << "the speed is the root of 4 kT in place of kT, " << k;
      Effects effects = changed.scene().effects;
      if (k == 4) {  // nothing is drawn for as long as nothing is hot
        effects.walls = {};
        changed.set_effects(effects);
      }
      if (k == 4 || k == 9) {
        for (const std::size_t w : {std::size_t{0}, std::size_t{1}}) effects.walls[w].temperature = k == 4 ? 1.0 : 4.0;
        changed.set_effects(effects);
      }
    }
  }
}

TEST(Changes, GoOnInTheStreamOfTheThermostat) {
  Scene scene = scene_of(box_of(8.0, 8.0, Boundary::periodic),
                         {species_of(1, 0.5, 1.0, ListedPositions{{{1.0, 4.0}}}, ListedVelocities{{{1.0, 0.0}}})});
  scene.effects.thermostat = Thermostat{1.0, 0.5};
  for (const char* engine : engines_with_effects) {
    Simulation plain = make_simulation(scene, engine), changed = make_simulation(scene, engine);
    for (int k = 0; k < 30; ++k) {
      const std::optional<Event> cool = plain.step(), hot = changed.step();
      ASSERT_NEAR(cool->time, hot->time, 1e-14 * cool->time) << "a kick comes when it was to come";
      ASSERT_EQ(hot->velocity, (k < 10 ? 1.0 : 2.0) * cool->velocity) << k;
      if (k != 9) continue;
      changed.run_until(changed.time() + 1e-6);
      Effects effects = changed.scene().effects;
      effects.thermostat->temperature = 4.0;
      changed.set_effects(effects);
    }
  }
}

TEST(Changes, OfTheRateDrawTheNextKickAnew) {
  Scene scene = scene_of(box_of(8.0, 8.0, Boundary::periodic),
                         {species_of(1, 0.5, 1.0, ListedPositions{{{1.0, 4.0}}}, ListedVelocities{{{1.0, 0.0}}})});
  scene.effects.thermostat = Thermostat{1.0, 0.5};
  Simulation plain = make_simulation(scene), changed = make_simulation(scene);
  std::vector<Event> kicks;
  for (int k = 0; k < 12; ++k) kicks.push_back(*plain.step());
  for (int k = 0; k < 5; ++k) (void)changed.step();
  Effects effects = scene.effects;
  effects.thermostat->rate = 0.0;
  changed.set_effects(effects);
  EXPECT_FALSE(changed.step(changed.time() + 1000.0));
  effects.thermostat->rate = 1.0;
  changed.set_effects(effects);
  const double begun = changed.time();
  const std::optional<Event> next = changed.step();
  EXPECT_EQ(next->velocity, kicks[6].velocity) << "number 5 was drawn and given up, and none is drawn twice";
  EXPECT_NEAR(next->time - begun, 0.5 * (kicks[6].time - kicks[5].time), 1e-9);
}

TEST(Changes, LeaveWallsThatStopWhereTheyAre) {
  Scene scene = gas_scene(20, 0.2, Boundary::walls);
  scene.effects.walls[1].velocity = 0.125;
  Simulation simulation = make_simulation(scene);
  simulation.run_until(2.0);
  Effects effects = simulation.scene().effects;
  effects.walls[1] = {};
  simulation.set_effects(effects);
  EXPECT_EQ(simulation.scene().box.upper.x(), scene.box.upper.x() + 0.25);
  EXPECT_EQ(simulation.engine(), "fast");
  double farthest = 0.0;
  for (int k = 1; k <= 200; ++k) {
    simulation.run_until(2.0 + 0.1 * k);
    farthest = std::max(farthest, simulation.state().positions.row(0).maxCoeff());
  }
  EXPECT_GT(farthest, scene.box.upper.x() - simulation.disks().radius[0]) << "disks go as far as where it stands";
  EXPECT_LE(farthest, scene.box.upper.x() + 0.25 - simulation.disks().radius[0] * (1.0 - 1e-12));
}

TEST(Changes, LetAWallThatIsToVibrateAgainBeginAnew) {
  for (const char* engine : {"auto", "textbook"}) {
    Scene scene = gas_scene(20, 0.2, Boundary::walls);
    scene.effects.walls[1].oscillation = Oscillation{WaveForm::sine, 0.1, 0.7, 0.3};
    Simulation simulation = make_simulation(scene, engine);
    simulation.run_until(0.7);
    simulation.set_effects({});
    simulation.run_until(1.5);
    simulation.set_effects(scene.effects);
    Simulation twin = make_simulation(simulation.scene(), simulation.state(), engine);
    simulation.run_until(1.5 + 0.125);
    twin.run_until(0.125);
    EXPECT_NEAR(simulation.state().walls[1].position, twin.state().walls[1].position, 1e-12) << engine;
  }
}

TEST(Changes, LeaveDisksThatStopGrowingAsLargeAsTheyAre) {
  Scene scene = gas_scene(20, 0.2, Boundary::periodic);
  scene.effects.growth = Growth{.rate = 0.0625};
  Simulation simulation = make_simulation(scene);
  simulation.run_until(4.0);
  Effects effects = simulation.scene().effects;
  effects.growth.reset();
  simulation.set_effects(effects);
  EXPECT_DOUBLE_EQ(simulation.disks().radius[0], 1.25 * scene.species[0].radius);
  EXPECT_EQ(simulation.scene().species[0].radius, simulation.disks().radius[0]);
  EXPECT_EQ(simulation.state().scale, 1.0);
  EXPECT_EQ(simulation.engine(), "fast");
  EXPECT_NEAR(simulation.scene().packing_fraction(), 0.2 * 1.25 * 1.25, 1e-9);
  simulation.run_until(20.0);
  EXPECT_THAT(simulation.check_invariants(), testing::IsEmpty());
}

/// Changes nothing after each passage of an edge of the pair potential.
void expect_pairs_kept_at_edges(const Scene& scene) {
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(scene, engine);
    const double energy = energy_of(simulation);
    std::uint64_t passed = 0;
    for (int k = 0; k < 400; ++k) {
      const std::uint64_t before = simulation.counts().well;
      (void)simulation.step();
      if (simulation.counts().well == before) continue;
      ++passed;
      const State before_change = simulation.state();
      simulation.set_effects(simulation.scene().effects);  // the two are at the edge now
      ASSERT_EQ(simulation.state().bonds, before_change.bonds) << engine << ", event " << k;
      ASSERT_EQ(simulation.state().pairs_in_steps, before_change.pairs_in_steps) << engine << ", event " << k;
    }
    EXPECT_GT(passed, 20U);
    EXPECT_NEAR(energy_of(simulation), energy, 1e-11 * energy) << engine;
  }
}

TEST(Changes, KeepTheEnergyOfPairsAtTheVeryEdgeOfWellsAndSteps) {
  Scene scene = gas_scene(30, 0.2, Boundary::periodic);
  scene.effects.square_well = SquareWell{1.5, 0.5};
  expect_pairs_kept_at_edges(scene);
  scene.effects.square_well.reset();
  scene.effects.stepped_potential = SteppedPotential{{{1.2, 0.5}, {1.4, -0.5}, {1.7, 0.2}}};
  expect_pairs_kept_at_edges(scene);
}

TEST(Changes, MayBeMadeByAConditionAtEveryEvent) {
  Scene scene = gas_scene(24, 0.1, Boundary::walls);
  Simulation simulation = make_simulation(scene);
  bool heavy = false;
  const auto swap_gravity = [&](const Event& /*event*/) {
    heavy = !heavy;
    Effects effects = simulation.scene().effects;
    effects.gravity = Gravity{{0.0, heavy ? -1.0 : -0.5}};
    simulation.set_effects(effects);
    return false;
  };
  EXPECT_EQ(simulation.run_until(1e3, {.events = 100, .stop_when = swap_gravity}), StopReason::events);
  EXPECT_EQ(simulation.counts().events(), 100U);
  EXPECT_THAT(simulation.check_invariants(), testing::IsEmpty());
}

TEST(Changes, LeaveRecordedEventsInTheLog) {
  Simulation simulation = make_simulation(gas_scene(24, 0.2, Boundary::walls));
  simulation.record_events(true);
  simulation.run_until(1.0);
  Effects effects = simulation.scene().effects;
  effects.collision.restitution = 0.9;
  simulation.set_effects(effects);
  simulation.run_until(2.0);
  const std::vector<Event> log = simulation.take_events();
  EXPECT_EQ(log.size(), simulation.counts().events());
  EXPECT_TRUE(std::is_sorted(log.begin(), log.end(), [](const Event& a, const Event& b) { return a.time < b.time; }));
}

TEST(Changes, AreRefusedInTheWordsOfTheCheckAndLeaveAllAsItWas) {
  Simulation simulation = make_simulation(gas_scene(24, 0.2, Boundary::periodic));
  Simulation untouched = make_simulation(gas_scene(24, 0.2, Boundary::periodic));
  simulation.run_until(1.0);
  const Effects good = simulation.scene().effects;
  const auto refused = [&](const std::function<void(Effects&)>& change) {
    Effects effects = good;
    change(effects);
    return refusal<SceneError>([&] { simulation.set_effects(effects); });
  };
  EXPECT_THAT(refused([](Effects& e) { e.gravity = Gravity{{0.0, -1.0}}; }), HasSubstr("where the box is periodic"));
  EXPECT_THAT(refused([](Effects& e) { e.collision.restitution = 1.5; }), HasSubstr("collision.restitution"));
  EXPECT_THAT(refused([](Effects& e) { e.thermostat = Thermostat{-1.0, 1.0}; }), HasSubstr("thermostat.temperature"));
  const Eigen::Vector2d disk = simulation.state().positions.col(3);
  EXPECT_THAT(refused([&](Effects& e) { e.obstacles = {DiskObstacle{disk, 0.1}}; }), HasSubstr("disk 3"));
  EXPECT_THAT(refused([](Effects& e) { e.growth = Growth{.rate = 0.1, .packing_fraction = 0.1}; }), HasSubstr("growth"));
  EXPECT_EQ(simulation.scene().effects.acting(), good.acting());
  simulation.run_until(3.0);
  untouched.run_until(3.0);
  EXPECT_TRUE(same_bits(simulation.state(), untouched.state()));
}

TEST(Changes, MaySetInMotionWhatWouldCloseTheBoxBeforeTheEndOfTheRun) {
  Scene scene = gas_scene(4, 0.2, Boundary::walls);
  scene.run.time = 1000.0;
  Simulation simulation = make_simulation(scene);
  simulation.run_until(1.0);
  Effects pushing = simulation.scene().effects;
  pushing.walls[1].velocity = -0.125;
  simulation.set_effects(pushing);
  simulation.run_until(2.0);
  simulation.set_effects(scene.effects);
  EXPECT_EQ(simulation.scene().box.upper.x(), scene.box.upper.x() - 0.125);
  simulation.set_effects(pushing);
  EXPECT_EQ(simulation.run_until(1000.0), StopReason::jammed) << "the disks have no room at last";
}

/// Equilibrating belongs to the time before the clock is set to zero; what does not go with it may act afterwards.
TEST(Changes, MayBringDragAndGrowthAfterTheEquilibration) {
  Scene scene = gas_scene(20, 0.2, Boundary::periodic);
  scene.run.equilibrate = Run::Equilibrate{.collisions_per_disk = {}, .time = 1.0};
  for (const bool drag : {true, false}) {
    Effects effects = scene.effects;
    if (drag) effects.drag = Drag{0.125};
    if (!drag) effects.growth = Growth{.rate = 0.0625};
    Simulation simulation = make_simulation(scene);
    EXPECT_THAT(refusal<SceneError>([&] { simulation.set_effects(effects); }), HasSubstr("run.equilibrate cannot be combined"));
    simulation.run_until(1.0);
    simulation.reset_clock();
    simulation.set_effects(effects);
    EXPECT_FALSE(simulation.scene().run.equilibrate) << "it is over, and the scene can begin another simulation";
    Simulation twin = make_simulation(simulation.scene(), simulation.state());
    EXPECT_EQ(simulation.run_until(0.5), twin.run_until(0.5));
    EXPECT_TRUE(same_bits(simulation.state(), twin.state()));
  }
}

TEST(Changes, AreRefusedWhereTheEngineAskedForDoesNotCoverThem) {
  Simulation simulation = make_simulation(gas_scene(24, 0.2, Boundary::walls), "fast");
  Effects effects = simulation.scene().effects;
  effects.gravity = Gravity{{0.0, -1.0}};
  EXPECT_THROW(simulation.set_effects(effects), std::invalid_argument);
}

TEST(Changes, AreRefusedByFixedStepsAndWithinSchedules) {
  Scene scene = gas_scene(24, 0.2, Boundary::walls);
  scene.run.time = 1.0;
  Simulation stepped = make_simulation(scene, FixedStep{"guarded", 0.01});
  EXPECT_THROW(stepped.set_effects(scene.effects), std::logic_error);
  EXPECT_THROW(stepped.set_velocities(stepped.state().velocities), std::logic_error);
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  hooks.start = [&](const State& state) { simulation.set_velocities(state.velocities); };
  EXPECT_THROW(run_schedule(simulation, hooks), std::logic_error);
  simulation.set_effects(scene.effects);  // it is not at work any more
}

TEST(Changes, AreRefusedAfterAScheduleWithinASchedule) {
  Scene scene = gas_scene(24, 0.2, Boundary::walls);
  scene.run.time = 1.0;
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  hooks.start = [&](const State& state) {
    (void)run_schedule(simulation);
    simulation.set_velocities(state.velocities);
  };
  EXPECT_THROW(run_schedule(simulation, hooks), std::logic_error);
}

}  // namespace
}  // namespace carom::test
