// The circular box: what it conserves, its pressure, its starts, and both engines in it.

#include "observe/effects_report.hpp"
#include "support/block_means.hpp"
#include "support/effect_scenes.hpp"
#include "support/engines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace carom::test {
namespace {

const Eigen::Vector2d middle_of_circle(1.5, -0.25);

Scene in_circle(double radius, std::vector<Species> species) {
  Scene scene = scene_of({}, std::move(species));
  put_in_circle(scene.box, scene.effects, {middle_of_circle, radius});
  scene.run.time = 1.0;
  return scene;
}

Scene disk_in_circle(double slope) {
  return in_circle(1.0, {species_of(1, 0.25, 2.0, ListedPositions{{middle_of_circle + Eigen::Vector2d(0.5, 0.0)}},
                                    ListedVelocities{{{std::cos(slope), std::sin(slope)}}})});
}

Scene gas_in_circle(std::int64_t count, double radius) {
  Scene scene = in_circle(4.0, {species_of(count, radius, 1.0, RandomPositions{}, MaxwellVelocities{1.0})});
  scene.run.seed = 5;
  return scene;
}

/// About the middle of the circle; `scale` becomes the sum of its parts' sizes.
double momentum_about_middle(const Simulation& simulation, double* scale = nullptr) {
  double sum = 0.0;
  const State state = simulation.state();
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    const Vec2<double> r = state.positions.col(i) - middle_of_circle, v = state.velocities.col(i);
    const double mass = simulation.disks().mass[static_cast<std::size_t>(i)];
    sum += mass * cross<double>(r, v);
    if (scale != nullptr) *scale += mass * r.norm() * v.norm();
  }
  return sum;
}

// 1e6 bounces, of which the log has the last ones: their chords are as long as the first.
TEST(Circle, ADiskKeepsItsAngularMomentumAndItsChord) {
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(disk_in_circle(1.0), engine);
    const double before = momentum_about_middle(simulation), b = 0.5 * std::sin(1.0);
    const double chord = 2.0 * std::sqrt(0.75 * 0.75 - b * b);
    simulation.run_until(1e9, {.events = 1'000'000});
    EXPECT_EQ(simulation.counts().obstacle, 1'000'000U);
    EXPECT_EQ(simulation.counts().wall, 0U) << "the square round the circle is not there";
    EXPECT_GT(simulation.totals().circle_impulse, 0.0) << engine;
    EXPECT_EQ(simulation.totals().obstacle_impulse.norm(), 0.0) << engine << ": there are no obstacles";
    EXPECT_NEAR(momentum_about_middle(simulation) / before, 1.0, 1e-12) << engine;
    EXPECT_NEAR(simulation.time() / (1'000'000 * chord), 1.0, 1e-6) << engine;
    simulation.record_events(true);
    simulation.run_until(2e9, {.events = 1'000'100});
    const std::vector<Event> events = simulation.take_events();
    ASSERT_EQ(events.size(), 100U);
    for (std::size_t k = 1; k < events.size(); ++k) {
      EXPECT_EQ(events[k].partner, first_obstacle) << "the rim comes after the obstacles, and there are none";
      EXPECT_NEAR((events[k].time - events[k - 1].time) + (events[k].time_remainder - events[k - 1].time_remainder), chord, 1e-9)
          << engine;
    }
    EXPECT_THAT(simulation.check_invariants(1e-12), testing::IsEmpty()) << engine;
  }
}

// Of starts anywhere in any direction a disk meets the rim P / (pi A) times per path: the mean chord is pi A / P, pi R / 2 of a
// circle. Each has chords of one length, which its angular momentum gives, and the number of its bounces is exact.
TEST(Circle, TheMeanChordIsPiTimesTheAreaOverThePerimeter) {
  constexpr double radius = 0.75, time = 60.0;
  constexpr std::uint64_t starts = 10'000;
  BlockMeans rate(1);
  for (std::uint64_t seed = 1; seed <= starts; ++seed) {
    Scene scene = in_circle(1.0, {species_of(1, 0.25, 1.0, RandomPositions{}, FixedSpeed{1.0})});
    scene.run.seed = seed;
    Simulation simulation = make_simulation(scene);
    const double b = momentum_about_middle(simulation), chord = 2.0 * std::sqrt(radius * radius - b * b);
    simulation.run_until(time);
    const auto bounces = static_cast<double>(simulation.counts().obstacle);
    EXPECT_NEAR(bounces * chord, time, chord * (1.0 + 1e-9)) << seed;
    rate.add(bounces / time);
  }
  EXPECT_LT(rate.error(), 0.01 * rate.mean());
  EXPECT_NEAR(rate.mean(), 2.0 / (std::numbers::pi * radius), 5.0 * rate.error());
}

/// The number of bounces in chords of that length along the rim until `time`, which are all of the log.
std::vector<Event> along_the_rim(double chord, double time, const char* engine, double& deepest, double& momentum) {
  const double slope = std::asin(chord / 2.0 / 0.75);
  Scene scene = disk_in_circle(0.0);
  std::get<ListedPositions>(scene.species[0].positions).values = {middle_of_circle + Eigen::Vector2d(0.75, 0.0)};
  std::get<ListedVelocities>(scene.species[0].velocities).values = {{-std::sin(slope), std::cos(slope)}};
  Ran ran = run(scene, engine, time);
  deepest = (ran.simulation.state().positions.col(0) - middle_of_circle).norm() - 0.75;
  momentum = momentum_about_middle(ran.simulation);
  return std::move(ran.events);
}

// A bounce changes the angular momentum by 1e-17 of itself, and that of a chord of 1e-6 is below the largest by 2e-13: such
// chords change with time, though none is lost or repeated. Those of 1e-4 stay.
TEST(Circle, AWhisperingGalleryLosesAndRepeatsNoEvent) {
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    double deepest = 0.0, momentum = 0.0;
    const std::vector<Event> coarse = along_the_rim(1e-4, 10.0, engine, deepest, momentum);
    // By 1e-12 of cos(slope), which 1e5 bounces may change, the slope is off by 2.5e-4 of itself at the end.
    EXPECT_NEAR(static_cast<double>(coarse.size()), 1e5, 15.0);
    EXPECT_LT(deepest, 4e-15);
    EXPECT_NEAR(momentum, 2.0 * 0.75 * std::cos(1e-4 / 1.5), 1e-11);

    const std::vector<Event> fine = along_the_rim(1e-6, 0.1, engine, deepest, momentum);
    EXPECT_LT(deepest, 4e-15);
    EXPECT_NEAR(momentum, 2.0 * 0.75, 1e-11);
    ASSERT_GT(static_cast<double>(fine.size()), 0.1 / 3e-6);
    EXPECT_LT(fine.front().time, 3e-6);
    EXPECT_GT(fine.back().time, 0.1 - 3e-6) << "the log reaches to the end";
    for (std::size_t k = 1; k < fine.size(); ++k) {
      const double flight = fine[k].time - fine[k - 1].time;
      ASSERT_GT(flight, 0.3e-6) << k;
      ASSERT_LT(flight, 3e-6) << k;
    }
  }
}

TEST(Circle, AGasKeepsItsAngularMomentumAboutTheCentre) {
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(gas_in_circle(40, 0.25), engine);
    double scale = 0.0;
    const double before = momentum_about_middle(simulation, &scale);
    simulation.run_until(1e9, {.events = 60'000});
    EXPECT_NEAR(momentum_about_middle(simulation), before, 1e-12 * scale) << engine;
    EXPECT_GT(simulation.counts().pair, 10'000U);
    EXPECT_GT(simulation.counts().obstacle, 10'000U);
    EXPECT_THAT(simulation.check_invariants(1e-12), testing::IsEmpty()) << engine;
  }
}

// A disk at speed v and distance S = R - rho gives 2 m v sin a to the rim after every chord 2 S sin a: m v^2 / S per time.
TEST(Circle, ThePressureIsThatOverItsPerimeter) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = disk_in_circle(0.7);
    Simulation simulation = make_simulation(scene, engine);
    simulation.run_until(3000.0);
    const EffectsReport report = effects_report(scene, simulation.disks(), simulation.totals(), simulation.state());
    ASSERT_TRUE(report.circle && report.circle->pressure);
    EXPECT_NEAR(*report.circle->pressure, 2.0 / 0.75 / (2.0 * std::numbers::pi), 2e-4) << engine;
    EXPECT_THAT(report.walls, testing::IsEmpty());
  }
}

TEST(Circle, BothEnginesFindTheSameCollisions) {
  for (const bool falls : {false, true}) {
    Scene scene = gas_in_circle(30, 0.3);
    scene.effects.obstacles = {ArcObstacle{middle_of_circle, 1.5, 20.0, 250.0},
                               ArcObstacle{middle_of_circle + Eigen::Vector2d(0.0, 3.0), 1.0, 180.0, 360.0},
                               DiskObstacle{middle_of_circle + Eigen::Vector2d(2.0, -1.0), 0.4}};
    if (falls) scene.effects.gravity = Gravity{{0.1, -0.4}};
    const Ran general = run(scene, "general", 1e9, 200), textbook = run(scene, "textbook", 1e9, 200);
    const Ran quad = run(scene, "textbook-long-double", 1e9, 60);
    const std::size_t first = std::min<std::size_t>({120, general.events.size(), textbook.events.size(), quad.events.size()});
    EXPECT_GT(first, 80U);
    for (std::size_t k = 0; k < first; ++k) {
      ASSERT_EQ(general.events[k].disk, textbook.events[k].disk) << k;
      ASSERT_EQ(general.events[k].partner, textbook.events[k].partner) << k;
      ASSERT_EQ(general.events[k].partner, quad.events[k].partner) << k;
      ASSERT_NEAR(general.events[k].time, textbook.events[k].time, 1e-6) << k;
    }
  }
}

TEST(Circle, ADrumUnderGravityKeepsTheEnergy) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_in_circle(30, 0.25);
    scene.effects.gravity = Gravity{{0.0, -1.0}};
    Simulation simulation = make_simulation(scene, engine);
    const double before = energy_of(simulation);
    simulation.run_until(1e9, {.events = 40'000});
    EXPECT_NEAR(energy_of(simulation), before, 1e-11 * std::abs(before)) << engine;
    EXPECT_THAT(simulation.check_invariants(1e-10), testing::IsEmpty()) << engine;
  }
}

TEST(Circle, GrowingDisksFillIt) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_in_circle(25, 0.2);
    scene.effects.growth = Growth{0.05, 0.6, {}};
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(simulation.run_until(1e9), StopReason::grown) << engine;
    EXPECT_THAT(simulation.check_invariants(1e-12), testing::IsEmpty()) << engine;
  }
}

TEST(Circle, StartsLieInside) {
  const std::vector<std::pair<Positions, std::int64_t>> starts = {{RandomPositions{}, 60},   {SquareLattice{}, 60},
                                                                  {HexagonalLattice{}, 100}, {HexagonalLattice{}, 7},
                                                                  {HexagonalLattice{}, 1},   {GrownPositions{0.7}, 56}};
  for (const auto& [positions, count] : starts) {
    double radius = 0.3;
    if (std::holds_alternative<GrownPositions>(positions)) radius = std::sqrt(0.7 * 16.0 / 56.0);
    Scene scene = in_circle(4.0, {species_of(count, radius, 1.0, positions, AtRest{})});
    const Simulation simulation = make_simulation(scene);
    const Eigen::Matrix2Xd places = simulation.state().positions;
    EXPECT_GE(smallest_distance(scene.box, places), 2.0 * radius * (1.0 - 1e-9));
    for (Eigen::Index i = 0; i < places.cols(); ++i)
      EXPECT_LE((places.col(i) - middle_of_circle).norm(), (4.0 - radius) * (1.0 + 1e-9));
  }
  const Scene seven = in_circle(3.0, {species_of(7, 1.0, 1.0, HexagonalLattice{}, AtRest{})});
  EXPECT_NO_THROW(static_cast<void>(make_simulation(seven))) << "seven coins fill a circle of three radii";
}

TEST(Circle, PackingFractionsCountItsArea) {
  EXPECT_NEAR(disk_in_circle(0.0).packing_fraction(), 0.0625, 1e-15);
  EXPECT_NEAR(gas_in_circle(32, 0.25).packing_fraction(), 0.125, 1e-15);
}

TEST(Circle, ItStaysWhereOtherEffectsChange) {
  Simulation simulation = make_simulation(gas_in_circle(10, 0.25));
  simulation.run_until(1.0);
  Effects effects;
  effects.gravity = Gravity{{0.0, -1.0}};
  simulation.set_effects(effects);
  ASSERT_TRUE(simulation.scene().effects.circle);
  EXPECT_EQ(simulation.scene().effects.circle->radius, 4.0);
  simulation.run_until(20.0);
  EXPECT_THAT(simulation.check_invariants(1e-12), testing::IsEmpty());
}

TEST(Circle, FarFromTheOriginDisksAreInsideToTheRoundingOfTheirCoordinates) {
  Scene scene = gas_in_circle(10, 0.25);
  put_in_circle(scene.box, scene.effects, {{333333.3, -285714.2}, 4.0});
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(scene, engine);
    for (std::uint64_t events = 1; events <= 300; ++events) {
      simulation.run_until(1000.0, {.events = events});
      ASSERT_THAT(simulation.check_invariants(), testing::IsEmpty()) << engine << " after event " << events;
    }
  }
}

TEST(Circle, BothPartsMustDescribeIt) {
  Scene scene = disk_in_circle(0.0);
  scene.effects.circle.reset();
  EXPECT_THROW(check(scene), SceneError);
  scene = disk_in_circle(0.0);
  scene.effects.circle->radius = 2.0;
  EXPECT_THROW(check(scene), SceneError);
}

}  // namespace
}  // namespace carom::test
