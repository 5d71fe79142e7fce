// Walls that vibrate with an amplitude, as a sine and as a sawtooth.

#include "core/real.hpp"
#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

Oscillation sine(double amplitude, double frequency, double phase = 0.0) { return {WaveForm::sine, amplitude, frequency, phase}; }
Oscillation sawtooth(double amplitude, double frequency, double phase = 0.0) {
  return {WaveForm::sawtooth, amplitude, frequency, phase};
}

/// One disk of radius 1/2 above a floor at y = 0 that vibrates.
Scene ball(const Oscillation& motion, const V& velocity, double height, double g, double restitution = 1.0) {
  Scene scene = scene_of_placed(box_of(8.0, 64.0, Boundary::walls), {{{4.0, 0.5 + height}, velocity}});
  scene.effects.walls[2].oscillation = motion;
  if (restitution != 1.0) scene.effects.walls[2].restitution = restitution;
  if (g != 0.0) scene.effects.gravity = Gravity{{0.0, -g}};
  return scene;
}

/// Where the floor is, inward of its start, and how fast, by the definition and the library's sine.
struct Floor {
  Quad height, velocity;
};
Floor floor_at(const Oscillation& motion, Quad time) {
  using std::cos;
  using std::floor;
  using std::sin;
  const Quad A = motion.amplitude, turn = 2 * boost::math::constants::pi<Quad>();
  const Quad at = motion.phase + motion.frequency * time;
  if (motion.form == WaveForm::sawtooth) return {2 * A * (at - floor(at) - motion.phase), 2 * A * motion.frequency};
  return {A * (sin(turn * at) - sin(turn * motion.phase)), turn * motion.frequency * A * cos(turn * at)};
}

double given_by(const Simulation& simulation) {
  double sum = 0.0;
  for (const double taken : simulation.totals().wall_energy) sum -= taken;
  return sum;
}

Scene vibrated_gas(const Oscillation& motion) {
  Scene scene = gas_scene(49, 0.25, Boundary::walls);
  scene.species[0].positions = RandomPositions{};
  scene.effects.gravity = Gravity{{0.0, -1.0}};
  scene.effects.walls[2].oscillation = motion;
  return scene;
}

TEST(OscillatingWalls, ASawtoothHitsADiskAsTheClosedFormSays) {
  // The floor rises from y = 0 by 1/2 in a unit of time and drops back. A disk whose edge is at 15/8 and falls at 1 is above the
  // floor until the second tooth: 15/8 - t = (t - 1)/2 at t = 19/12; then v' = (1 + e) u - e v.
  for (const char* engine : engines_with_effects)
    for (const double e : {1.0, 0.5, 0.0}) {
      const Ran ran = run(ball(sawtooth(0.25, 1.0), {0.0, -1.0}, 1.875, 0.0, e), engine, 1.6);
      ASSERT_EQ(ran.events.size(), 1U) << engine;
      EXPECT_NEAR(ran.events[0].time, 19.0 / 12.0, 4e-16) << engine;
      EXPECT_NEAR(ran.events[0].velocity.y(), (1 + e) * 0.5 + e, 1e-15);
      EXPECT_NEAR(ran.simulation.state().walls.at(2).position, 0.3, 1e-15);
      EXPECT_EQ(ran.simulation.state().walls.at(2).velocity, 0.5);
    }
}

TEST(OscillatingWalls, ADiskThatTheyLeaveBehindIsNotHit) {
  // A disk at rest just above the innermost position of the floor; and one that the floor drops away from before it gets there.
  for (const char* engine : engines_with_effects)
    for (const Oscillation& motion : {sawtooth(0.25, 3.0), sine(0.25, 3.0)}) {
      EXPECT_EQ(run(ball(motion, {0.0, 0.0}, 0.5 + 1e-9, 0.0), engine, 50.0).events.size(), 0U) << engine;
      EXPECT_GT(run(ball(motion, {0.0, 0.0}, 0.25 - 1e-9, 0.0), engine, 50.0).events.size(), 0U) << engine;
    }
}

TEST(OscillatingWalls, ABallBouncesAsInTheMapOfHighPrecision) {
  // From each hit of the engine the next one follows in 113 bits: the floor by its definition, the ball on its parabola, the
  // first time at which they meet by looking in steps of 1/500 of the time the floor takes for its amplitude, and then by
  // halving.
  for (const char* engine : engines_with_effects)
    for (const double e : {1.0, 0.75})
      for (const Oscillation& motion : {sine(0.5, 0.75), sine(0.125, 4.0, 0.3), sawtooth(0.5, 0.75), sawtooth(0.125, 4.0, 0.3)}) {
        constexpr double turn = 2.0 * std::numbers::pi;
        SCOPED_TRACE(testing::Message() << engine << ", e = " << e << ", f = " << motion.frequency
                                        << (motion.form == WaveForm::sine ? ", sine" : ", sawtooth"));
        const Ran ran = run(ball(motion, {0.0, -0.5}, 2.0, 1.0, e), engine, 200.0, no_limit);
        ASSERT_GT(ran.events.size(), 10U);
        Quad y = 2, v = -0.5, time = 0;  // of the lower edge
        for (std::size_t k = 0; k < std::min<std::size_t>(ran.events.size(), 40); ++k) {
          if (ran.events[k].partner != wall_bottom) break;                         // it has come to the top
          if (k > 9 && ran.events[k].time - ran.events[k - 1].time < 1e-3) break;  // it comes to rest on the floor for a while
          const auto gap = [&](Quad t) { return y + t * (v - t / 2) - floor_at(motion, time + t).height; };
          // The search is in double precision, far from where its digits would decide.
          const double start = motion.phase + motion.frequency * static_cast<double>(time), y0 = static_cast<double>(y),
                       v0 = static_cast<double>(v),
                       middle_of_way = motion.form == WaveForm::sine ? std::sin(turn * motion.phase) : 0.0;
          const auto seen = [&](double t) {
            const double at = start + motion.frequency * t;
            const double height =
                motion.form == WaveForm::sine ? std::sin(turn * at) - middle_of_way : 2.0 * (at - std::floor(at) - motion.phase);
            return y0 + t * (v0 - t / 2.0) - motion.amplitude * height;
          };
          const double step = 1.0 / (500.0 * motion.frequency);
          double before = k == 0 ? 0.0 : 1e-6 / motion.frequency, after = before + step;
          while (seen(after) > 0.0) before = after, after += step;
          Quad low = before, high = after;
          for (int halving = 0; halving < 110; ++halving) {
            const Quad middle = (low + high) / 2;
            (gap(middle) > 0 ? low : high) = middle;
          }
          const Quad u = floor_at(motion, time + low).velocity, arrives = v - low;
          const auto closing = static_cast<double>(u - arrives), found = static_cast<double>(time + low);
          // Heights, up to 64, and the phase are known to some roundings of double precision.
          const double rounding = 1e-13 * (1.0 + motion.frequency) / closing + 4e-16 * found;
          ASSERT_NEAR(ran.events[k].time, found, rounding) << "hit " << k;
          // In that time the velocities of ball and floor change.
          const double omega = 2 * 3.1416 * motion.frequency;
          const double bends = 1.0 + (motion.form == WaveForm::sine ? omega * omega * motion.amplitude : 0.0);
          ASSERT_NEAR(ran.events[k].velocity.y(), static_cast<double>((1 + Quad(e)) * u - Quad(e) * arrives),
                      1e-13 + 3.0 * bends * rounding)
              << "hit " << k;
          time = ran.events[k].time;
          y = floor_at(motion, time).height;
          v = ran.events[k].velocity.y();
        }
      }
}

/// What the floor gave to disks of mass 1 in a run, found from the events alone.
struct Given {
  double impulse = 0.0, work = 0.0, energy = 0.0;
};

/// Returns what a floor gives that moves like that. Requires a simulation at its start that records events.
Given given_by_floor(Simulation& simulation, const Oscillation& motion, double until) {
  std::vector<V> velocities;
  for (Eigen::Index i = 0; i < simulation.state().velocities.cols(); ++i)
    velocities.emplace_back(simulation.state().velocities.col(i));
  std::vector<double> since(velocities.size(), 0.0);
  simulation.run_until(until);
  Given given;
  for (const Event& event : simulation.take_events()) {
    const auto i = static_cast<std::size_t>(event.disk);
    const double before = velocities[i].y() - (event.time - since[i]), after = event.velocity.y();
    if (event.partner == wall_bottom) {
      given.work += (after - before) * static_cast<double>(floor_at(motion, event.time).velocity);
      given.impulse += after - before;
      given.energy += (after - before) * (after + before) / 2;
    }
    velocities[i] = event.velocity, since[i] = event.time;
    if (event.partner >= 0) {
      const auto j = static_cast<std::size_t>(event.partner);
      velocities[j] = event.partner_velocity, since[j] = event.time;
    }
  }
  return given;
}

TEST(OscillatingWalls, GiveTheEnergyOfTheirImpulsesTimesTheirVelocity) {
  for (const char* engine : engines_with_effects)
    for (const Oscillation& motion : {sine(0.25, 2.0), sawtooth(0.25, 2.0)}) {
      Simulation simulation = make_simulation(vibrated_gas(motion), engine);
      simulation.record_events(true);
      const double energy = energy_of(simulation);
      const Given found = given_by_floor(simulation, motion, 20.0);
      const double given = -simulation.totals().wall_energy[2];
      EXPECT_GT(given, 10.0);
      EXPECT_NEAR(found.work, given, 1e-11 * found.impulse * 2 * 3.2 * 0.5) << engine;
      EXPECT_NEAR(-simulation.totals().wall_work[2], given, 1e-11 * found.impulse) << engine;
      EXPECT_NEAR(energy + given_by(simulation), energy_of(simulation), 1e-11 * (energy + given));
      EXPECT_THAT(simulation.check_invariants(), testing::IsEmpty());
    }
}

TEST(OscillatingWalls, TakeHeatBesideTheirWorkWhereTheyAreInelastic) {
  for (const char* engine : engines_with_effects)
    for (const Oscillation& motion : {sine(0.25, 2.0), sawtooth(0.25, 2.0)}) {
      Scene scene = vibrated_gas(motion);
      scene.effects.walls[2].restitution = 0.8;
      Simulation simulation = make_simulation(scene, engine);
      simulation.record_events(true);
      const Given found = given_by_floor(simulation, motion, 20.0);
      const Totals totals = simulation.totals();
      const double rounding = 1e-11 * found.impulse * 2 * 3.2;
      EXPECT_NEAR(-totals.wall_work[2], found.work, rounding) << engine;
      EXPECT_NEAR(-totals.wall_energy[2], found.energy, rounding) << engine;
      EXPECT_GT(found.work - found.energy, 1.0) << engine << ": the floor takes heat";
    }
}

TEST(OscillatingWalls, LetNoDiskThroughInAHundredThousandEvents) {
  for (const char* engine : engines_with_effects)
    for (const Oscillation& motion : {sine(0.25, 3.0), sawtooth(0.25, 3.0, 0.5), sine(1e-3, 500.0)}) {
      Scene scene = vibrated_gas(motion);
      scene.effects.collision.restitution = 0.95;
      scene.effects.collision.elastic_below = 1e-5;
      Simulation simulation = make_simulation(scene, engine);
      const int parts = std::string(engine) == "general" ? 10 : 1;
      for (int part = 0; part < parts; ++part) {
        const auto events = static_cast<std::uint64_t>(part + 1) * 10'000;
        ASSERT_EQ(simulation.run_until(1e9, {.events = events}), StopReason::events) << engine;
        ASSERT_THAT(simulation.check_invariants(1e-12), testing::IsEmpty()) << engine << ", part " << part;
      }
      EXPECT_GT(simulation.counts().wall, 100U);
    }
}

TEST(OscillatingWalls, AreTheSameInBothEngines) {
  for (const Oscillation& motion : {sine(0.25, 3.0, 0.2), sawtooth(0.25, 3.0, 0.2)}) {
    const Scene scene = vibrated_gas(motion);
    const Ran a = run(scene, "general", 1.5), b = run(scene, "textbook", 1.5);
    ASSERT_GT(a.events.size(), 100U);
    ASSERT_EQ(a.events.size(), b.events.size());
    for (std::size_t k = 0; k < 60; ++k) {
      ASSERT_EQ(a.events[k].disk, b.events[k].disk) << k;
      ASSERT_EQ(a.events[k].partner, b.events[k].partner) << k;
      ASSERT_NEAR(a.events[k].time, b.events[k].time, 1e-9) << k;
    }
  }
}

TEST(OscillatingWalls, WithoutAmplitudeOrFrequencyHaveTheSameBits) {
  for (const char* engine : engines_with_effects)
    for (const Oscillation& still :
         {sine(0.0, 2.0, 0.3), sine(0.5, 0.0, 0.3), sawtooth(0.0, 2.0, 0.3), sawtooth(0.5, 0.0, 0.3)}) {
      Scene scene = gas_scene(64, 0.3, Boundary::walls);
      scene.effects.gravity = Gravity{{0.0, -0.1}};
      const Ran a = run(scene, engine, 5.0);
      scene.effects.walls[2].oscillation = still;
      const Ran b = run(scene, engine, 5.0);
      EXPECT_EQ(a.simulation.state().positions, b.simulation.state().positions) << engine;
      EXPECT_EQ(a.simulation.state().velocities, b.simulation.state().velocities) << engine;
      EXPECT_TRUE(b.simulation.state().walls.empty());
    }
  Scene scene = gas_scene(64, 0.3, Boundary::walls);
  scene.effects.walls[2].oscillation = sine(0.0, 2.0);
  EXPECT_EQ(make_simulation(scene).engine(), "fast");
}

TEST(OscillatingWalls, AWholePeriodLaterIsTheSame) {
  for (const char* engine : engines_with_effects)
    for (const Oscillation& motion : {sine(0.25, 3.0), sawtooth(0.25, 3.0)}) {
      Scene scene = vibrated_gas(motion);
      const Ran a = run(scene, engine, 5.0);
      scene.effects.walls[2].oscillation->phase = 1.0;
      const Ran b = run(scene, engine, 5.0);
      EXPECT_EQ(a.simulation.state().positions, b.simulation.state().positions) << engine;
      EXPECT_EQ(a.simulation.state().walls.at(2).position, b.simulation.state().walls.at(2).position);
    }
}

TEST(OscillatingWalls, ASawtoothOfLittleAmplitudeIsAWallWithoutAny) {
  // At the same velocity 2 A f, where each flight is longer than many periods.
  for (const char* engine : engines_with_effects) {
    Scene limit = ball(sawtooth(0.0, 1.0), {0.0, -1.0}, 2.0, 1.0, 0.9);
    limit.effects.walls[2] = {.restitution = 0.9, .vibration = 0.25};
    const Ran a = run(limit, engine, 40.0);
    const Ran b = run(ball(sawtooth(1e-10, 0.125e10), {0.0, -1.0}, 2.0, 1.0, 0.9), engine, 40.0);
    ASSERT_GT(a.events.size(), 5U);
    ASSERT_EQ(a.events.size(), b.events.size()) << engine;
    // The floor is up to 2 A higher at each hit: a flight differs by that over the speed of arrival, about 1, and adds to those
    // before it.
    for (std::size_t k = 0; k < a.events.size(); ++k) {
      EXPECT_NEAR(a.events[k].time, b.events[k].time, 1e-7) << engine << ", hit " << k;
      EXPECT_NEAR(a.events[k].velocity.y(), b.events[k].velocity.y(), 1e-7);
    }
  }
}

TEST(OscillatingWalls, ABallThatCannotLeaveAWeakFloorEndsTheRun) {
  // The floor's acceleration is below gravity: bounces become ever smaller, as on a floor at rest, and the run says so.
  for (const char* engine : engines_with_effects) {
    const Scene scene = ball(sine(0.05, 0.5), {0.0, 0.0}, 1.0, 1.0, 0.5);
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(simulation.run_until(1000.0), StopReason::collapsed) << engine;
    EXPECT_LT(simulation.time(), 100.0);
  }
  // An elastic floor never stops it.
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(ball(sine(0.05, 0.5), {0.0, 0.0}, 0.0, 1.0), engine);
    EXPECT_EQ(simulation.run_until(20.0, {.events = 1'000'000}), StopReason::time) << engine;
  }
}

TEST(OscillatingWalls, ARunThatIsSavedGoesOnToTheSameBits) {
  for (const char* engine : {"general", "textbook", "textbook-quad"})
    for (const Oscillation& motion : {sine(0.25, 3.0, 0.2), sawtooth(0.25, 3.0, 0.2)}) {
      const auto [whole, restored] = gone_on_and_restored(vibrated_gas(motion), engine, 2.3, 5.0);
      EXPECT_EQ(whole.state().positions, restored.state().positions) << engine;
      EXPECT_EQ(whole.state().walls.at(2).position, restored.state().walls.at(2).position);
    }
}

TEST(OscillatingWalls, GoOnAsTheyDidWhereSomethingElseChanges) {
  for (const char* engine : engines_with_effects)
    for (const Oscillation& motion : {sine(0.25, 3.0, 0.2), sawtooth(0.25, 3.0, 0.2)}) {
      const Scene scene = vibrated_gas(motion);
      Simulation whole = make_simulation(scene, engine), changed = make_simulation(scene, engine);
      changed.run_until(0.4);
      Effects effects = changed.scene().effects;
      effects.walls[0].restitution = 1.0;  // which changes nothing
      changed.set_effects(effects);
      for (const double time : {0.4, 0.55, 0.7, 0.85}) {
        whole.run_until(time);
        changed.run_until(time);
        EXPECT_NEAR(whole.state().walls.at(2).position, changed.state().walls.at(2).position, 1e-15) << engine;
        EXPECT_NEAR(whole.state().walls.at(2).velocity, changed.state().walls.at(2).velocity, 1e-13) << engine;
        EXPECT_LT((whole.state().positions - changed.state().positions).cwiseAbs().maxCoeff(), 1e-9) << engine << ", " << time;
      }
      // Another motion begins where the wall stands.
      const double stands = changed.state().walls.at(2).position;
      effects.walls[2].oscillation = sine(0.1, 1.0, 0.75);
      changed.set_effects(effects);
      EXPECT_NEAR(changed.state().walls.at(2).position, stands, 1e-15);
      changed.run_until(0.85 + 0.5);
      EXPECT_NEAR(changed.state().walls.at(2).position, stands + 0.2, 1e-14) << "from the outermost position to the innermost";
      effects.walls[2].oscillation.reset();
      changed.set_effects(effects);
      EXPECT_NEAR(changed.scene().box.lower.y(), stands + 0.2, 1e-14) << "where it stands still";
      changed.run_until(2.0);
      EXPECT_THAT(changed.check_invariants(1e-12), testing::IsEmpty());
    }
}

TEST(OscillatingWalls, MayBeNearAnObstacleWhenSomethingElseChanges) {
  // At 0.9 of a period of 4 the floor is at 0.494 of 0.5: it comes 0.006 further, and an obstacle begins at 0.6.
  for (const char* engine : engines_with_effects) {
    Scene scene = ball(sine(0.5, 0.25), {0.0, 0.0}, 2.0, 1.0);
    scene.effects.obstacles = {DiskObstacle{{1.0, 1.6}, 1.0}};
    scene.run.time = 3.0;
    scene.changes = {{0.9, SetKeys{{"gravity.acceleration=[0.0,-2.0]"}}}};
    Simulation simulation = make_simulation(scene, engine);
    const RunResult result = run_schedule(simulation, {});
    EXPECT_EQ(result.blocked_by, "") << engine;
    EXPECT_EQ(simulation.time(), 3.0);
    Effects nearer = simulation.scene().effects;
    nearer.obstacles = {DiskObstacle{{1.0, 1.4}, 1.0}};  // the floor is below its start now, and comes 1 further
    EXPECT_THAT([&] { simulation.set_effects(nearer); },
                testing::ThrowsMessage<SceneError>(testing::HasSubstr("walls.bottom comes 1 inward in each period")));
  }
}

TEST(OscillatingWalls, AreNotRefusedForAPlaceThatIsUnknownBefore) {
  // How long it takes to equilibrate by collisions is known when it is over, so where the floor stands is, too. From wherever it
  // is below its start the new sine reaches no obstacle.
  Scene scene = vibrated_gas(sine(0.5, 0.25));
  scene.effects.obstacles = {DiskObstacle{{2.0, 1.6}, 1.0}};
  scene.run = {.time = 3.0, .equilibrate = Run::Equilibrate{.collisions_per_disk = 2.0}};
  scene.changes = {{1.0, SetKeys{{"walls.bottom={ vibration = { form = \"sine\", amplitude = 0.5, frequency = 0.5 } }"}}}};
  EXPECT_NO_THROW(check(scene));
}

TEST(OscillatingWalls, KeepTheirPhaseInALongRun) {
  // A hundred thousand periods, whose length is no sum of powers of two, over many epochs: the floor is where its definition has
  // it.
  for (const char* engine : engines_with_effects) {
    const Oscillation motion = sine(0.25, 1000.0 / 3.0);
    Scene scene = ball(motion, {0.25, 0.0}, 8.0, 0.0);
    Simulation simulation = make_simulation(scene, engine);
    simulation.run_until(300.7);
    EXPECT_NEAR(simulation.state().walls.at(2).position, static_cast<double>(floor_at(motion, 300.7).height), 1e-13) << engine;
  }
}

TEST(OscillatingWalls, MayShakeTheWholeBox) {
  // Floor and ceiling in step: in the frame of the box disks feel gravity that changes as a sine. They never come out.
  for (const char* engine : engines_with_effects) {
    Scene scene = vibrated_gas(sine(0.5, 1.0));
    scene.effects.walls[3].oscillation = sine(0.5, 1.0, 0.5);
    Simulation simulation = make_simulation(scene, engine);
    const double height = scene.box.lengths().y();
    for (const double time : {1.1, 2.35, 3.6, 4.85}) {
      simulation.run_until(time);
      const State state = simulation.state();
      EXPECT_NEAR(state.walls.at(3).position - state.walls.at(2).position, height, 1e-13) << engine;
      EXPECT_THAT(simulation.check_invariants(1e-12), testing::IsEmpty());
    }
  }
}

TEST(OscillatingWalls, AreForSeveralCores) {
  const Scene scene = vibrated_gas(sine(0.25, 3.0));
  EXPECT_EQ(make_simulation(scene).why_not_threads(), "");
}

}  // namespace
}  // namespace carom::test
