// A run on several cores has the bits of the run on one: for any number of domains and threads, any halo and window, and wherever
// one stops.

#include "support/engines.hpp"
#include "support/several_cores.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace carom::test {
namespace {

void expect_same_runs(const Scene& scene, const Threads& threads, double time, int stops) {
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads(threads);
  for (int k = 1; k <= stops; ++k) {
    alone.run_until(time * k / stops);
    EXPECT_EQ(shared.run_until(time * k / stops), StopReason::time);
    expect_same(alone, shared, "stop " + std::to_string(k));
  }
  EXPECT_TRUE(shared.check_invariants().empty());
  EXPECT_GT(shared.thread_counts().windows, 10U);
  EXPECT_LT(shared.thread_counts().windows_redone, shared.thread_counts().windows / 4);
}

TEST(Threads, GiveTheBitsOfOneForAnyNumberOfDomains) {
  for (const std::size_t domains : {2U, 3U, 8U, 16U})
    expect_same_runs(lean_gas(4000, 0.6, Boundary::periodic), {.threads = 1, .domains = domains}, 6.0, 3);
}

/// A run stops every now and then at a number of collisions, of which a lattice has few at first and then many.
TEST(Threads, KeepTheirWindowsAfterAStartFromALattice) {
  for (const Positions& lattice : {Positions{HexagonalLattice{}}, Positions{SquareLattice{}}})
    for (const double packing_fraction : {0.3, 0.45, 0.6, 0.7}) {
      Scene scene = gas_scene(4096, packing_fraction, Boundary::periodic);
      scene.species.front().positions = lattice;
      scene.run.time = 8.0;
      Simulation alone = make_simulation(scene), shared = make_simulation(scene);
      shared.set_threads({.threads = 1, .domains = 2});
      run_schedule(alone, {});
      run_schedule(shared, {});
      expect_same(alone, shared, std::to_string(packing_fraction));
      EXPECT_GT(shared.thread_counts().windows, 20U);
      EXPECT_LE(shared.thread_counts().windows_redone, 2U) << packing_fraction;
      // A void window costs one core what its epoch has had so far; a second one in the same epoch, all of it.
      const ThreadCounts counts = shared.thread_counts();
      const auto epochs = static_cast<double>(shared.totals().numerics.epochs);
      EXPECT_LE(counts.share_alone(), std::min(static_cast<double>(counts.windows_redone) / epochs, 0.3)) << packing_fraction;
    }
}

TEST(Threads, GiveTheBitsOfOneForAnyNumberOfThreads) {
  for (const std::size_t threads : {2U, 3U, 4U})
    expect_same_runs(lean_gas(6000, 0.5, Boundary::walls), {.threads = threads}, 4.0, 2);
}

TEST(Threads, GiveTheBitsOfOneForEveryLeanScene) {
  expect_same_runs(lean_gas(5000, 0.3, Boundary::walls), {.domains = 4}, 10.0, 3);
  expect_same_runs(lean_gas(5000, 0.72, Boundary::periodic), {.domains = 4}, 2.0, 3);
  expect_same_runs(lean_gas(5000, 0.4, Boundary::periodic, CollisionRule::reversal), {.domains = 4}, 6.0, 3);
  expect_same_runs(mixture(3000), {.domains = 4}, 8.0, 3);
  expect_same_runs(lean_gas(4000, 0.02, Boundary::periodic), {.domains = 4}, 200.0, 3);
}

TEST(Threads, GiveTheBitsOfOneUnderGravity) {
  for (const Boundary across : {Boundary::walls, Boundary::periodic}) {
    Scene scene = lean_gas(4000, 0.4, Boundary::walls);
    scene.box.boundary[0] = across;
    scene.effects.gravity = Gravity{{0.0, -0.2}};
    expect_same_runs(scene, {.threads = 2, .domains = 4}, 20.0, 4);
  }
}

TEST(Threads, GiveTheBitsOfOneWhereCollisionsLoseEnergy) {
  Scene scene = lean_gas(4000, 0.4, Boundary::periodic);
  scene.effects.collision.restitution = 0.9;
  expect_same_runs(scene, {.domains = 4}, 20.0, 4);
  scene.effects.collision.elastic_below = 1e-3;
  expect_same_runs(scene, {.domains = 3}, 20.0, 4);
  scene.box.boundary = {Boundary::walls, Boundary::walls};
  scene.effects.walls[2].restitution = 0.7;
  scene.effects.gravity = Gravity{{0.0, -0.1}};
  expect_same_runs(scene, {.domains = 4}, 20.0, 4);
}

/// A disk that a wall leaves no speed, and that weight presses against it, hits it again and again at one instant: far more often
/// in a window than a domain lets happen, and less often than time is taken to stand still after.
TEST(Threads, CollapseWhereOneDoes) {
  Scene scene = lean_gas(40, 0.2, Boundary::walls);
  scene.effects.walls[1].restitution = 0.0;
  scene.effects.gravity = Gravity{{0.5, 0.0}};
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 2});
  EXPECT_EQ(alone.run_until(20.0), StopReason::collapsed);
  EXPECT_EQ(shared.run_until(20.0), StopReason::collapsed);
  expect_same(alone, shared, "collapsed");
  EXPECT_GT(shared.thread_counts().windows_redone, 0U);
}

TEST(Threads, GiveTheBitsOfOneForAGasInACorner) {
  Scene scene = lean_gas(3000, 0.5, Boundary::walls);
  scene.species[0].positions = ListedPositions{};
  scene.box.upper *= 4.0;
  const int columns = 60;
  for (int i = 0; i < 3000; ++i)
    std::get<ListedPositions>(scene.species[0].positions)
        .values.emplace_back(1.0 + 1.2 * (i % columns), 1.0 + 1.2 * (i / columns));
  expect_same_runs(scene, {.domains = 4}, 60.0, 3);
}

TEST(Threads, GiveTheBitsOfOneForRoughDisks) {
  Scene scene = lean_gas(4000, 0.4, Boundary::periodic);
  scene.effects.collision.restitution = 0.95;
  scene.effects.collision.roughness = 0.3;
  expect_same_runs(scene, {.domains = 4}, 10.0, 4);
}

TEST(Threads, GiveTheBitsOfOneForDisksWithWells) {
  Scene scene = lean_gas(4000, 0.3, Boundary::periodic);
  scene.effects.square_well = SquareWell{.width = 1.6, .depth = 0.8};
  expect_same_runs(scene, {.threads = 2, .domains = 4}, 10.0, 4);
  scene.effects.square_well = SquareWell{.width = 1.9, .depth = -0.3};
  expect_same_runs(scene, {.domains = 3}, 6.0, 2);
}

TEST(Threads, GiveTheBitsOfOneForDisksWithSteppedPotentials) {
  Scene scene = lean_gas(4000, 0.3, Boundary::periodic);
  scene.effects.stepped_potential = SteppedPotential{{{1.1, 0.5}, {1.3, -0.4}, {1.6, 0.2}, {1.9, -0.1}}};
  expect_same_runs(scene, {.threads = 2, .domains = 4}, 6.0, 4);
  expect_same_runs(scene, {.threads = 3, .domains = 3}, 6.0, 2);
}

TEST(Threads, ArePutAsideWhereADiskMayHaveMorePartnersThanAMessageHolds) {
  Scene scene = mixture_scene(64, 0.3, Boundary::periodic);
  scene.effects.square_well = SquareWell{1.5, 0.5};
  for (Species& species : scene.species) species.radius = 0.5;
  EXPECT_EQ(make_simulation(scene).why_not_threads(), "");
  scene.species[0].radius = 0.1;
  EXPECT_EQ(make_simulation(scene).why_not_threads(),
            "sizes differ so much that a disk may have too many others within reach of the potential");
  scene.effects.square_well.reset();
  EXPECT_EQ(make_simulation(scene).why_not_threads(), "");
}

TEST(Threads, GiveTheBitsOfOneBetweenWallsThatVibrate) {
  Scene scene = lean_gas(3000, 0.4, Boundary::walls);
  scene.effects.collision.restitution = 0.9;
  scene.effects.collision.elastic_below = 1e-3;
  scene.effects.gravity = Gravity{{0.0, -0.5}};
  for (const WaveForm form : {WaveForm::sine, WaveForm::sawtooth}) {
    scene.effects.walls[2] = {.restitution = 0.95, .oscillation = Oscillation{form, 0.4, 1.5}};
    expect_same_runs(scene, {.threads = 2, .domains = 4}, 10.0, 4);
    scene.effects.walls[0] = {.oscillation = Oscillation{form, 2.0, 0.3, 0.6}};
    expect_same_runs(scene, {.domains = 3}, 10.0, 3);
  }
  scene.effects.walls[1] = scene.effects.walls[2] = {.vibration = 0.8};
  expect_same_runs(scene, {.domains = 8}, 10.0, 3);
}

/// In the epoch that begins at time 8 the domain at the left gets more disks than it has room for, and all goes back to the
/// beginning of the epoch: what the domain could not read by then makes no plan stale.
TEST(Threads, GoBackToTheRightPlansWhereADomainHasNoRoom) {
  Scene scene = lean_gas(3000, 0.4, Boundary::walls);
  scene.effects.collision.restitution = 0.9;
  scene.effects.gravity = Gravity{{0.0, -0.5}};
  scene.effects.walls[2] = {.restitution = 0.95, .oscillation = Oscillation{WaveForm::sine, 0.4, 1.5}};
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 2, .halo = 10.0});
  alone.run_until(8.3);
  shared.run_until(8.3);
  expect_same(alone, shared, "no room");
  EXPECT_GT(shared.thread_counts().windows_redone, 0U);
}

/// Walls that go far beyond the box, where coordinates become coarser, and one that presses the gas together.
TEST(Threads, GiveTheBitsOfOneBetweenWallsThatMove) {
  Scene scene = lean_gas(3000, 0.4, Boundary::walls);
  scene.effects.walls[1].velocity = 3.0;
  scene.effects.walls[2].velocity = -1.0;
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 4});
  for (const double time : {5.0, 40.0, 200.0}) {
    alone.run_until(time);
    shared.run_until(time);
    expect_same(alone, shared, "time " + std::to_string(time));
    EXPECT_EQ(shared.state().walls.at(1).position, alone.state().walls.at(1).position);
  }
  EXPECT_GT(shared.state().walls.at(1).position, 8.0 * scene.box.upper[0]);
  EXPECT_GT(shared.thread_counts().windows, 10U);
  scene.effects.walls[1].velocity = -0.5;
  scene.effects.walls[2].velocity = 0.0;
  expect_same_runs(scene, {.domains = 3}, 30.0, 3);
}

/// The redraws of velocities that a scene may have.
enum class Redrawing { thermostat, tumbling, brownian };
constexpr Redrawing all_redrawing[] = {Redrawing::thermostat, Redrawing::tumbling, Redrawing::brownian};

void redraw(Scene& scene, Redrawing how, double rate, double temperature = 1.0) {
  if (how == Redrawing::thermostat) scene.effects.thermostat = Thermostat{temperature, rate};
  if (how == Redrawing::tumbling) scene.effects.tumbling = Tumbling{rate};
  if (how == Redrawing::brownian) scene.effects.brownian = Brownian{temperature, rate};
}

TEST(Threads, GiveTheBitsOfOneWhereVelocitiesAreRedrawn) {
  for (const Redrawing how : all_redrawing)
    for (const double rate : {0.1, 4.0}) {  // a disk collides some five times in a unit of time
      Scene scene = lean_gas(4000, 0.5, Boundary::periodic);
      redraw(scene, how, rate);
      for (const std::size_t domains : {2U, 3U, 16U}) expect_same_runs(scene, {.domains = domains}, 3.0, 3);
      scene.box.boundary = {Boundary::walls, Boundary::walls};
      expect_same_runs(scene, {.threads = 3, .domains = 4}, 3.0, 2);
    }
}

TEST(Threads, GiveTheBitsOfOneWhereVelocitiesAreRedrawnBesideOtherEffects) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = mixture(3000);
    redraw(scene, how, 1.0);
    expect_same_runs(scene, {.domains = 4}, 8.0, 3);
    scene = lean_gas(3000, 0.3, Boundary::walls);
    scene.effects.gravity = Gravity{{0.0, -0.1}};
    redraw(scene, how, 1.0);
    expect_same_runs(scene, {.domains = 4}, 8.0, 3);
    scene = lean_gas(3000, 0.3, Boundary::periodic);
    scene.effects.square_well = SquareWell{.width = 1.6, .depth = 0.8};
    redraw(scene, how, 1.0);
    expect_same_runs(scene, {.domains = 3}, 6.0, 3);
    scene = lean_gas(3000, 0.3, Boundary::periodic);
    scene.effects.collision.restitution = 0.9;
    scene.effects.collision.roughness = 0.3;
    redraw(scene, how, 1.0);
    expect_same_runs(scene, {.threads = 2, .domains = 4}, 6.0, 3);
    scene.effects.growth = Growth{.rate = 0.01};  // spins are redrawn for the moment of inertia of that time
    expect_same_runs(scene, {.domains = 3}, 6.0, 3);
  }
}

/// Redraws at the time of every sample: a step that is a sum of powers of two is not rounded.
TEST(Threads, GiveTheBitsOfOneWhereRedrawsAndStopsComeAtOneTime) {
  Scene scene = lean_gas(4000, 0.5, Boundary::periodic);
  redraw(scene, Redrawing::brownian, 4.0);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  for (int k = 1; k <= 12; ++k) {
    alone.run_until(0.25 * k);
    shared.run_until(0.25 * k);
    expect_same(alone, shared, "stop " + std::to_string(k));
    EXPECT_EQ(shared.counts().thermostat, 4000U * static_cast<unsigned>(k));
  }
  EXPECT_LT(shared.thread_counts().shared_out, 6U) << "not once for each stop";
}

/// Compares a scene that is shared out with one core at these times. Returns what sharing it out took.
ThreadCounts expect_same_at(const std::vector<double>& times, const Scene& scene, const Threads& threads) {
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads(threads);
  for (const double time : times) {
    alone.run_until(time);
    shared.run_until(time);
    expect_same(alone, shared, "time " + std::to_string(time));
  }
  return shared.thread_counts();
}

/// Disks from the bath are far faster than any was when the epoch began: halos must know, and epochs end early.
TEST(Threads, GiveTheBitsOfOneInABathThatIsMuchHotter) {
  for (const Redrawing how : {Redrawing::thermostat, Redrawing::brownian})
    for (const double temperature : {1e2, 1e8}) {
      Scene scene = lean_gas(4000, 0.4, Boundary::walls);
      redraw(scene, how, temperature > 1e4 ? 0.02 : 1.0, temperature);
      SCOPED_TRACE("kT " + std::to_string(temperature));
      expect_same_at({0.5, 1.0}, scene, {.domains = 4});
    }
}

TEST(Threads, BeginAtRestWhereABathMovesDisks) {
  for (const Redrawing how : {Redrawing::thermostat, Redrawing::brownian}) {
    Scene scene = lean_gas(2000, 0.4, Boundary::periodic);
    scene.species[0].velocities = MaxwellVelocities{0.0};
    redraw(scene, how, 1.0);
    EXPECT_GT(expect_same_at({2.0, 6.0, 12.0}, scene, {.domains = 4}).windows, 10U);
  }
}

/// A window that is void takes back the redraws in it, and their energy.
TEST(Threads, MakeRedrawsOfVoidWindowsOnce) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = lean_gas(6000, 0.5, Boundary::periodic);
    redraw(scene, how, 2.0);
    const ThreadCounts counts = expect_same_at({0.7, 4.0}, scene, {.domains = 4, .halo = 3.0, .events_per_window = 1.0});
    EXPECT_GT(counts.windows_redone, 0U);
  }
}

TEST(Threads, StopAtExactNumbersBetweenRedraws) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = lean_gas(4000, 0.5, Boundary::walls);
    redraw(scene, how, 2.0);
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.threads = 2, .domains = 4});
    for (const std::uint64_t collisions : {1U, 3000U, 20001U, 20002U}) {
      EXPECT_EQ(alone.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
      EXPECT_EQ(shared.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
      expect_same(alone, shared, std::to_string(collisions) + " collisions");
    }
    const std::uint64_t events = alone.counts().events() + 10'000;
    EXPECT_EQ(alone.run_until(1e6, {.events = events}), StopReason::events);
    EXPECT_EQ(shared.run_until(1e6, {.events = events}), StopReason::events);
    expect_same(alone, shared, "events");
    for (int step = 0; step < 20; ++step) {
      const auto a = alone.step(), b = shared.step();
      ASSERT_TRUE(a && b);
      EXPECT_EQ(a->disk, b->disk);
      EXPECT_EQ(a->partner, b->partner);
    }
    expect_same(alone, shared, "steps");
  }
}

TEST(Threads, GoOnWithRedrawsFromWhatOtherNumbersOfThemHaveSaved) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = lean_gas(4000, 0.5, Boundary::periodic);
    redraw(scene, how, 1.0);
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.domains = 4});
    alone.run_until(5.0);
    shared.run_until(1.9);
    std::stringstream saved;
    shared.save(saved);
    Simulation one = restore_simulation(scene, saved);
    one.run_until(3.1);
    std::stringstream again;
    one.save(again);
    Simulation three = restore_simulation(scene, again);
    three.set_threads({.domains = 3});
    three.run_until(5.0);
    expect_same(alone, three, "resumed");
  }
}

/// Velocities are scaled each time that a disk has collided once on average, and lists are made for larger disks now and then.
TEST(Threads, GiveTheBitsOfOneWhereDisksGrow) {
  Scene scene = lean_gas(4000, 0.3, Boundary::periodic);
  for (const double rate : {0.003, 0.05}) {
    scene.effects.growth = Growth{.rate = rate};
    expect_same_runs(scene, {.threads = 2, .domains = 4}, 8.0, 4);
  }
  scene.effects.collision.restitution = 0.95;
  scene.effects.collision.roughness = 0.3;
  expect_same_runs(scene, {.domains = 3}, 8.0, 3);
  scene = lean_gas(3000, 0.3, Boundary::walls);
  scene.effects.gravity = Gravity{{0.0, -0.1}};
  scene.effects.growth = Growth{.rate = 0.02};
  expect_same_runs(scene, {.domains = 4}, 8.0, 3);
  scene = mixture(2000);
  scene.effects.growth = Growth{.rate = 0.02};
  expect_same_runs(scene, {.domains = 4}, 8.0, 3);
}

TEST(Threads, StopWhereDisksHaveGrownAsMuchAsOnOne) {
  Scene scene = lean_gas(4000, 0.3, Boundary::periodic);
  for (const Growth& growth : {Growth{.rate = 0.1, .packing_fraction = 0.6}, Growth{.rate = 0.02, .reduced_pressure = 4.0}}) {
    scene.effects.growth = growth;
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.domains = 4});
    EXPECT_EQ(alone.run_until(1000.0), StopReason::grown);
    EXPECT_EQ(shared.run_until(1000.0), StopReason::grown);
    expect_same(alone, shared, "grown");
    EXPECT_GT(shared.thread_counts().windows, 10U);
  }
}

/// A gas that cools down to a thousandth of its speed has windows a thousand times as long.
TEST(Threads, AdaptWindowsToDisksThatBecomeSlow) {
  Scene scene = lean_gas(4000, 0.4, Boundary::periodic);
  scene.effects.collision.restitution = 0.7;
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  alone.run_until(2000.0);
  shared.run_until(2000.0);
  expect_same(alone, shared, "cold");
  EXPECT_LT(shared.thread_counts().windows, 20 * alone.totals().pair / 4000);
}

/// Cold disks that a heavy one runs into leave it much faster than any disk was when the epoch began.
TEST(Threads, GiveTheBitsOfOneWhereADiskOutrunsItsEpoch) {
  Scene scene = lean_gas(4000, 0.2, Boundary::periodic);
  scene.species[0].velocities = MaxwellVelocities{1e-3};
  Species ball = scene.species[0];
  ball.name = "ball";
  ball.count = 1;
  ball.mass = 1e4;
  ball.positions = ListedPositions{{{1.0, 1.0}}};
  ball.velocities = ListedVelocities{{{5.0, 2.0}}};
  scene.species[0].positions = RandomPositions{};
  scene.species.insert(scene.species.begin(), ball);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  for (const double time : {2.0, 10.0}) {
    alone.run_until(time);
    shared.run_until(time);
    expect_same(alone, shared, "time " + std::to_string(time));
  }
  EXPECT_GT(alone.totals().numerics.early_epochs, 0U);
  EXPECT_EQ(shared.totals().numerics.early_epochs, alone.totals().numerics.early_epochs);
  EXPECT_GT(shared.thread_counts().windows_redone, 0U);
}

/// A window that is void leaves the disks to one core up to the end of its epoch, but no longer where the clock begins anew.
TEST(Threads, ComputeAgainAfterTheClockBeganAnew) {
  Scene scene = lean_gas(4000, 0.2, Boundary::periodic);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4, .halo = 2.5, .events_per_window = 3.0});
  double time = 0.0;
  while (shared.thread_counts().windows_redone == 0) {
    ASSERT_LT(time, 100.0);
    shared.run_until(time += 0.01);
  }
  alone.run_until(time);
  expect_same(alone, shared, "where a window was void");
  alone.reset_clock();
  shared.reset_clock();
  const std::uint64_t windows = shared.thread_counts().windows;
  alone.run_until(0.5 * time);
  shared.run_until(0.5 * time);
  EXPECT_GT(shared.thread_counts().windows, windows);
  expect_same(alone, shared, "on the new clock");
}

TEST(Threads, GiveTheBitsOfOneBetweenObstacles) {
  Scene scene = lean_gas(3000, 0.3, Boundary::walls);
  const double x = scene.box.upper[0] / 2.0, y = scene.box.upper[1] / 2.0;
  scene.species[0].positions = RandomPositions{};
  scene.effects.obstacles = {DiskObstacle{{x, y}, 5.0}, SegmentObstacle{{x / 3.0, y / 4.0}, {x / 3.0, y}}};
  expect_same_runs(scene, {.domains = 4}, 10.0, 4);
}

TEST(Threads, GiveTheBitsOfOneInACircle) {
  Scene scene = lean_gas(3000, 0.3, Boundary::walls);
  scene.species[0].positions = RandomPositions{};
  const Eigen::Vector2d middle = 0.5 * (scene.box.lower + scene.box.upper);
  put_in_circle(scene.box, scene.effects, {middle, 0.57 * scene.box.lengths().x()});
  scene.effects.obstacles = {ArcObstacle{middle, 0.25 * scene.box.lengths().x(), 10.0, 300.0}};
  expect_same_runs(scene, {.domains = 4}, 10.0, 4);
}

TEST(Threads, FindEveryWindowThatTheirHalosAreTooNarrowFor) {
  std::uint64_t redone = 0;
  for (const double halo : {2.5, 3.0, 4.0, 6.0})
    for (const double events : {0.2, 1.0, 3.0}) {
      const Scene scene = lean_gas(6000, 0.5, Boundary::periodic);
      Simulation alone = make_simulation(scene), shared = make_simulation(scene);
      shared.set_threads({.domains = 4, .halo = halo, .events_per_window = events});
      alone.run_until(8.0);
      shared.run_until(8.0);
      expect_same(alone, shared, "halo " + std::to_string(halo));
      redone += shared.thread_counts().windows_redone;
    }
  EXPECT_GT(redone, 10U);
}

/// Between slow disks two others leave a shoulder, on which they began, 44 times as fast. The light one of them flies across half
/// a halo within a window, hits what is at home there, and is gone again when copies are compared.
TEST(Threads, FindWhatShouldersHaveMadeFast) {
  Scene scene = lean_gas(2, 0.1, Boundary::walls);
  scene.box = {{0.0, 0.0}, {400.0, 10.0}, {Boundary::walls, Boundary::walls}};
  Species& disks = scene.species[0];
  ListedPositions places;
  ListedVelocities velocities;
  disks.count = 0;
  const auto put = [&](double x, double y, const Eigen::Vector2d& v, double mass) {
    places.values.emplace_back(x, y), velocities.values.push_back(v), disks.masses.push_back(mass), ++disks.count;
  };
  for (double x = 1.5; x < 399.0; x += 3.0) put(x, 1.5, {0.02, 0.02}, 1.0), put(x, 8.5, {0.02, -0.02}, 1.0);
  put(187.0, 5.0, {0.02, 0.0}, 1.0), put(185.51, 5.0, {-0.02, 0.0}, 1000.0), put(206.0, 5.0, {0.0, 0.0}, 1000.0);
  disks.positions = places;
  disks.velocities = velocities;
  scene.effects.square_well = SquareWell{.width = 1.5, .depth = -0.4};
  for (const std::size_t domains : {2U, 3U, 4U}) {
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.domains = domains});
    alone.run_until(33.0);
    shared.run_until(33.0);
    expect_same(alone, shared, std::to_string(domains) + " domains");
  }
}

/// 1/3 and its multiples are at the end of an epoch to the last bit, and behind it by less than that.
TEST(Threads, GiveTheBitsOfOneWhereAStopIsTheEndOfAnEpochToRounding) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scene scene = load_scene(CAROM_SOURCE_DIR "/docs/scenes/gas.toml");
    scene.run.seed = seed;
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.domains = 2});
    for (int k = 1; k <= 9; ++k) {
      for (Simulation* simulation : {&alone, &shared}) {
        simulation->run_until(k / 3.0);
        if (k == 3) simulation->set_velocities(0.9 * simulation->state().velocities);
      }
      expect_same(alone, shared, "seed " + std::to_string(seed) + ", stop " + std::to_string(k));
    }
  }
}

/// The log is taken once, when windows have been void, right and void again.
TEST(Threads, LogTheEventsOfOneAfterWindowsThatWereVoid) {
  const Scene scene = lean_gas(4000, 0.5, Boundary::periodic);
  std::uint64_t redone = 0;
  const auto logged = [&](const Threads& threads) {
    Simulation simulation = make_simulation(scene);
    simulation.set_threads(threads);
    simulation.record_events(true);
    simulation.run_until(6.0);
    redone += simulation.thread_counts().windows_redone;
    std::vector<std::tuple<double, std::int32_t, std::int32_t>> events;
    for (const Event& event : simulation.take_events()) events.emplace_back(event.time, event.disk, event.partner);
    return events;
  };
  const auto alone = logged({});
  for (const double halo : {4.0, 5.0, 6.0})
    EXPECT_TRUE(logged({.domains = 4, .halo = halo, .events_per_window = 0.3}) == alone) << halo;
  EXPECT_GT(redone, 4U);
}

/// A window that is void takes back what happened since the whole engine was last up to date, which is more than a caller may ask
/// for at a time. Such a caller would see a run that goes nowhere.
TEST(Threads, NeverGoBackBehindWhatTheyHaveTold) {
  const Scene scene = lean_gas(6000, 0.5, Boundary::periodic);
  const auto engine = make_engine("fast", scene);
  engine->set_threads({.domains = 4, .halo = 3.5, .events_per_window = 0.1});
  std::uint64_t pairs = 0;
  Instant time{};
  while (pairs < 200'000) {
    ASSERT_FALSE(engine->run_about(Instant{1e6, 0.0}, 1'000'000, 500));
    ASSERT_GT(engine->counts().pair, pairs);
    ASSERT_TRUE(time < engine->now());
    pairs = engine->counts().pair;
    time = engine->now();
  }
  EXPECT_GT(engine->thread_counts().windows_redone, 2U);
}

TEST(Threads, StopAtAnExactNumberOfCollisions) {
  const Scene scene = lean_gas(6000, 0.6, Boundary::periodic);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 4});
  for (const std::uint64_t collisions : {1U, 3000U, 20001U, 20002U, 50000U}) {
    EXPECT_EQ(alone.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
    EXPECT_EQ(shared.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
    expect_same(alone, shared, std::to_string(collisions) + " collisions");
  }
}

TEST(Threads, StopAtAnExactNumberOfEvents) {
  const Scene scene = lean_gas(4000, 0.5, Boundary::walls);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 3});
  for (const std::uint64_t events : {10U, 30000U}) {
    EXPECT_EQ(alone.run_until(1e6, {.events = events}), StopReason::events);
    EXPECT_EQ(shared.run_until(1e6, {.events = events}), StopReason::events);
    expect_same(alone, shared, std::to_string(events) + " events");
  }
}

TEST(Threads, GoOnFromWhatOtherNumbersOfThemHaveSaved) {
  const Scene scene = lean_gas(4000, 0.5, Boundary::periodic);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  alone.run_until(6.0);
  shared.run_until(2.3);
  std::stringstream saved;
  shared.save(saved);
  Simulation one = restore_simulation(scene, saved);
  one.run_until(4.1);
  std::stringstream again;
  one.save(again);
  Simulation three = restore_simulation(scene, again);
  three.set_threads({.domains = 3});
  three.run_until(6.0);
  expect_same(alone, three, "resumed");
}

TEST(Threads, GoOnAfterSingleStepsAndChanges) {
  const Scene scene = lean_gas(4000, 0.5, Boundary::periodic);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  for (Simulation* simulation : {&alone, &shared}) {
    simulation->run_until(1.0);
    simulation->step();
    simulation->run_until(2.0);
    simulation->set_velocities(-simulation->state().velocities);
    simulation->run_until(3.5);
    simulation->reset_clock();
    simulation->run_until(1.0);
  }
  expect_same(alone, shared, "after changes");
  shared.set_threads({});
  alone.run_until(2.0);
  shared.run_until(2.0);
  expect_same(alone, shared, "on one core again");
}

TEST(Threads, BeginWhereAChangeEndsWhatKeepsTheRunOnOneCore) {
  Scene scene = lean_gas(4000, 0.5, Boundary::periodic);
  scene.effects.drag = Drag{0.02};
  EXPECT_EQ(make_simulation(scene).why_not_threads(), "drag slows the clock");
  EXPECT_THROW(make_simulation(scene).set_threads({.domains = 3}), std::invalid_argument);
  scene.changes = {{0.5, SetKeys{{"drag.rate=0"}}}};
  EXPECT_THROW(make_simulation(scene, "textbook").set_threads({.domains = 3}), std::invalid_argument);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  EXPECT_EQ(shared.why_not_threads(), "");
  shared.set_threads({.domains = 3});
  alone.run_until(2.0);
  shared.run_until(0.3);
  EXPECT_EQ(shared.thread_counts().windows, 0U);
  std::stringstream saved;
  shared.save(saved);
  Simulation resumed = restore_simulation(scene, saved);
  resumed.set_threads({.domains = 4});
  for (Simulation* simulation : {&shared, &resumed}) {
    simulation->run_until(2.0);
    EXPECT_GT(simulation->thread_counts().windows, 0U);
    expect_same(alone, *simulation, "after drag");
  }
}

TEST(Threads, CountWhatTheyTookThroughChanges) {
  Scene scene = lean_gas(4000, 0.5, Boundary::walls);
  Simulation shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 4});
  shared.run_until(1.0);
  const ThreadCounts before = shared.thread_counts();
  EXPECT_GT(before.windows, 2U);
  scene.effects.collision.restitution = 0.9;
  shared.set_effects(scene.effects);
  EXPECT_EQ(shared.thread_counts().windows, before.windows);
  shared.run_until(2.0);
  const ThreadCounts after = shared.thread_counts();
  EXPECT_GT(after.windows, before.windows + 2U);
  EXPECT_EQ(after.shared_out, before.shared_out + 1U);
  EXPECT_EQ(after.threads, 2U);
  EXPECT_EQ(after.domains, 4U);
  scene.effects.drag = Drag{.rate = 0.01};  // one core computes from now on
  scene.effects.collision.restitution.reset();
  shared.set_effects(scene.effects);
  shared.run_until(2.5);
  EXPECT_EQ(shared.thread_counts().windows, after.windows);
  EXPECT_EQ(shared.thread_counts().domains, 4U);
  shared.set_threads({});
  EXPECT_EQ(shared.thread_counts().domains, 1U) << "they are those since set_threads()";
}

TEST(Threads, RunASchedule) {
  Scene scene = lean_gas(4000, 0.5, Boundary::periodic);
  scene.run.equilibrate = Run::Equilibrate{.collisions_per_disk = 4.0};
  scene.run.time = 3.0;
  scene.run.sample_every = 0.1;
  std::vector<std::string> hashes[2];
  std::vector<double> blocks[2];
  for (const std::size_t domains : {1U, 4U}) {
    Simulation simulation = make_simulation(scene);
    simulation.set_threads({.domains = domains});
    const std::size_t n = domains > 1 ? 1 : 0;
    RunHooks hooks;
    hooks.sample = [&](std::uint64_t, const State& state) { hashes[n].push_back(state_hash(state)); };
    hooks.block = [&](const Progress& progress) {
      blocks[n].push_back(progress.time);
      blocks[n].push_back(progress.totals.virial);
    };
    run_schedule(simulation, hooks);
    if (domains > 1) {
      EXPECT_GT(simulation.thread_counts().windows, 20U);
    }
  }
  EXPECT_EQ(hashes[0].size(), 31U);
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_GT(blocks[0].size(), 4U);
  EXPECT_EQ(blocks[1], blocks[0]);
}

/// Every collision, told as run_schedule() tells them: as records with their epochs, and as events.
struct Told {
  std::vector<double> records;
  std::vector<double> events;
};

/// The log of a run, with time, disk, partner and a number of velocities of each event.
std::vector<double> told_events(const Scene& scene, const Threads& threads) {
  std::vector<double> told;
  Simulation simulation = make_simulation(scene);
  simulation.set_threads(threads);
  RunHooks hooks;
  hooks.events = [&](std::span<const Event> events) {
    for (const Event& event : events) {
      told.push_back(event.time);
      told.push_back(event.disk);
      told.push_back(event.partner);
      told.push_back(event.velocity[0] - event.partner_velocity[1]);
    }
  };
  run_schedule(simulation, hooks);
  return told;
}

Told told(const Scene& scene, const Threads& threads, std::uint64_t& redone) {
  Told told;
  Simulation simulation = make_simulation(scene);
  simulation.set_threads(threads);
  RunHooks hooks;
  hooks.collisions = [&](const CollisionRecords& collisions) {
    for (const CollisionRecord& record : collisions.records) {
      told.records.push_back(collisions.epoch + record.time);
      told.records.push_back(record.slot_i);
      told.records.push_back(record.slot_j);
      told.records.push_back(record.before_i[0] + record.before_j[1]);
      told.records.push_back(record.after_i[1] - record.after_j[0]);
    }
  };
  run_schedule(simulation, hooks);
  told.events = told_events(scene, threads);
  redone = simulation.thread_counts().windows_redone;
  if (threads.domains > 1) {
    EXPECT_GT(simulation.thread_counts().windows, 2U);
  }
  return told;
}

TEST(Threads, TellTheCollisionsOfOneInTheirOrder) {
  Scene scene = lean_gas(4000, 0.5, Boundary::walls);
  scene.run.time = 3.0;
  scene.run.sample_every = 0.5;
  std::uint64_t redone = 0;
  const Told alone = told(scene, {}, redone);
  EXPECT_GT(alone.records.size(), 100000U);
  const Told shared = told(scene, {.threads = 2, .domains = 4}, redone);
  EXPECT_EQ(shared.records, alone.records);
  EXPECT_EQ(shared.events, alone.events);
  const Told narrow = told(scene, {.domains = 4, .halo = 5.0, .events_per_window = 2.0}, redone);
  EXPECT_GT(redone, 0U) << "collisions are to happen twice, and to be told once";
  EXPECT_EQ(narrow.records, alone.records);
  EXPECT_EQ(narrow.events, alone.events);
}

/// Rough disks that lose all of their speed towards each other but for its rounding collide again at once, by the plan of the one
/// and then of the other, which may be at home in two domains, and with a third disk in between.
TEST(Threads, TellTheCollisionsOfOneInstantInTheirOrder) {
  Scene scene = mixture(300);
  scene.effects.collision.restitution = 0.0;
  scene.effects.collision.roughness = 1.0;
  scene.run.time = 6.0;
  const std::vector<double> alone = told_events(scene, {});
  std::size_t at_once = 0;
  for (std::size_t k = 4; k < alone.size(); k += 4) at_once += std::equal(&alone[k], &alone[k + 3], &alone[k - 4]) ? 1U : 0U;
  EXPECT_GT(at_once, 20U);
  for (const std::size_t domains : {2U, 3U, 5U, 8U, 13U}) EXPECT_EQ(told_events(scene, {.domains = domains}), alone) << domains;
}

/// Disks of a lattice that meet many others at the same time and lose all of their speed towards each other.
TEST(Threads, HandOnTheRecordsOfOneInstantInTheirOrder) {
  Scene scene = lean_gas(144, 0.1, Boundary::walls);
  scene.box = {{0.0, 0.0}, {12.0, 12.0}, {Boundary::walls, Boundary::walls}};
  ListedPositions positions;
  ListedVelocities velocities;
  std::uint64_t draw = 1;
  for (int k = 0; k < 144; ++k) {
    draw = 6364136223846793005U * draw + 1442695040888963407U;
    positions.values.emplace_back(0.5 + k / 12, 0.5 + k % 12);
    velocities.values.emplace_back((draw >> 40) % 2 == 0 ? 0.5 : -0.5, (draw >> 50) % 2 == 0 ? 0.5 : -0.5);
  }
  Species& species = scene.species.front();
  species.radius = 0.25;
  species.positions = positions;
  species.velocities = velocities;
  scene.effects.collision.restitution = 0.0;
  scene.run.time = 2.0;
  scene.run.sample_every = 0.25;
  std::uint64_t redone = 0;
  const Told alone = told(scene, {}, redone);
  for (const std::size_t domains : {2U, 3U, 5U}) {
    const Told shared = told(scene, {.domains = domains}, redone);
    EXPECT_EQ(shared.records, alone.records) << domains;
    EXPECT_EQ(shared.events, alone.events) << domains;
  }
}

/// Most disks of a lattice meet in pairs at the time at which all velocities are redrawn, and some of them meet again at once.
TEST(Threads, TellCollisionsAndRedrawsOfOneInstantInTheirOrder) {
  Scene scene = lean_gas(400, 0.2, Boundary::walls);
  scene.box = {{0.0, 0.0}, {40.0, 40.0}, {Boundary::walls, Boundary::walls}};
  ListedPositions positions;
  ListedVelocities velocities;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y) {
      positions.values.emplace_back(1.0 + 2.0 * x, 1.0 + 2.0 * y);
      velocities.values.push_back(y % 3 == 0 ? Eigen::Vector2d(0.0, 0.5) : Eigen::Vector2d(x % 2 == 0 ? 1.0 : -1.0, 0.0));
    }
  scene.species.front().positions = positions;
  scene.species.front().velocities = velocities;
  redraw(scene, Redrawing::brownian, 2.0);
  scene.run.time = 2.0;
  scene.run.sample_every = 0.5;
  const std::vector<double> alone = told_events(scene, {});
  std::size_t at_once = 0;
  for (std::size_t k = 0; k < alone.size(); k += 4) at_once += alone[k] == 0.5 ? 1U : 0U;
  EXPECT_GT(at_once, 140U) << "130 pairs meet, and some of them again";
  for (const std::size_t domains : {2U, 3U, 8U}) EXPECT_EQ(told_events(scene, {.domains = domains}), alone) << domains;
}

TEST(Threads, RefuseWhatTheyCannotDo) {
  Simulation simulation = make_simulation(lean_gas(100, 0.3, Boundary::walls));
  EXPECT_THROW(simulation.set_threads({.threads = 0}), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.threads = 33}), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.domains = 33}), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.threads = 2, .halo = -1.0}), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.threads = 2, .events_per_window = -1.0}), std::invalid_argument);
  Simulation textbook = make_simulation(lean_gas(100, 0.3, Boundary::walls), "textbook");
  EXPECT_FALSE(textbook.why_not_threads().empty());
  EXPECT_THROW(textbook.set_threads({.threads = 2}), std::invalid_argument);
  textbook.set_threads({});
}

}  // namespace
}  // namespace carom::test
