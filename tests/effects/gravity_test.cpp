// Disks that fall: [gravity].

#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

Scene falling(Scene scene, const V& g) {
  scene.effects.gravity = Gravity{g};
  return scene;
}

TEST(Gravity, ADiskBouncesAlongParabolasInClosedForm) {
  // Height 2 above the floor at g = 4: it falls for 1, and is up again every 2. Along x it drifts at 1/16. All are dyadic
  // numbers.
  for (const char* engine : engines_with_effects) {
    const Scene scene = falling(scene_of_placed(box_of(64.0, 8.0, Boundary::walls), {{{1.0, 2.5}, {0.0625, 0.0}}}), {0.0, -4.0});
    Simulation simulation = make_simulation(scene, engine);
    for (int k = 0; k <= 4000; ++k) {
      const double t = k / 8.0;
      simulation.run_until(t);
      const double since = std::fmod(t, 2.0) - (std::fmod(t, 2.0) > 1.0 ? 2.0 : 0.0);  // since the last apex, or until the next
      const State state = simulation.state();
      // Heights are rounded to u of the box, and to the eighth part of that in the clock's times and velocities.
      ASSERT_NEAR(state.positions(1, 0), 2.5 - 2.0 * since * since, 1e-12) << engine << ", t = " << t;
      ASSERT_NEAR(state.positions(0, 0), 1.0 + t / 16, 1e-12) << engine << ", t = " << t;
    }
    EXPECT_EQ(simulation.totals().wall, 250U);
  }
}

TEST(Gravity, TwoDisksNeverNoticeItFromEachOther) {
  for (const char* engine : engines_with_effects) {
    const std::vector<Placed> pair = {{{-2.0, 8.0}, {1.0, 2.0}}, {{2.0, 8.6}, {-1.0, 2.0}, 0.5, 3.0}};
    const Box box{{-16.0, 0.0}, {16.0, 32.0}, {Boundary::walls, Boundary::walls}};
    const Ran free = run(scene_of_placed(box, pair), engine, 2.0);
    const Ran fall = run(falling(scene_of_placed(box, pair), {0.5, -1.0}), engine, 2.0);
    ASSERT_EQ(free.events.size(), 1U);
    ASSERT_EQ(fall.events.size(), 1U);
    const double t = free.events[0].time;
    EXPECT_NEAR(fall.events[0].time, t, 1e-14);
    EXPECT_LE((fall.events[0].velocity - free.events[0].velocity - t * V(0.5, -1.0)).norm(), 1e-13);
    EXPECT_LE((fall.events[0].partner_velocity - free.events[0].partner_velocity - t * V(0.5, -1.0)).norm(), 1e-13);
  }
}

TEST(Gravity, KeepsEnergyAndTheBalanceOfForcesToRounding) {
  // 1e5 events. The floor's impulse less the ceiling's is the weight times the time, less what the disks' momentum changed by.
  for (const char* engine : engines_with_effects)
    for (const bool mixture : {false, true}) {
      SCOPED_TRACE(engine);
      const Scene scene =
          falling(mixture ? mixture_scene(64, 0.3, Boundary::walls) : gas_scene(64, 0.3, Boundary::walls), {0.0, -0.5});
      Simulation simulation = make_simulation(scene, engine);
      const double energy = energy_of(simulation);
      const V momentum = total_momentum(simulation.disks(), simulation.state());
      simulation.run_until(1e9, {.collisions = 85'000});
      EXPECT_GT(simulation.totals().pair + simulation.totals().wall, 100'000U);
      EXPECT_NEAR(energy_of(simulation) / energy, 1.0, 1e-11) << "1e-10 is the promise over 1e6 events";
      double mass = 0.0;
      for (const double m : simulation.disks().mass) mass += m;
      const auto& impulse = simulation.totals().wall_impulse;
      const double gained = total_momentum(simulation.disks(), simulation.state())[1] - momentum[1];
      const double weight = 0.5 * mass * simulation.time();
      EXPECT_NEAR((impulse[2] - impulse[3] - gained) / weight, 1.0, 1e-12) << "sums of 1e5 impulses, and as many roundings";
      EXPECT_TRUE(simulation.check_invariants().empty());
    }
}

TEST(Gravity, FindsItsWayBack) {
  // rho* = 0.4 as for the free gas (tests/physics/laws_test.cpp), whose error grows by four decades or so from T = 1 to 3.
  for (const char* engine : engines_with_effects)
    for (const auto& [time, bound] : {std::pair{1.0, 1e-12}, std::pair{3.0, 1e-7}}) {
      const Scene scene = falling(gas_scene(64, 0.4 * std::numbers::pi / 4, Boundary::walls), {0.3, -0.5});
      const auto [start, there, back] = there_and_back(scene, engine, time);
      EXPECT_GT(back.totals().pair, 20U);
      EXPECT_LE((back.state().positions - start.positions).cwiseAbs().maxCoeff(), bound) << engine << ", T = " << time;
    }
}

TEST(Gravity, NoDiskLeavesItsNeighbourhoodUnseenWhenTheFallingFrameIsReset) {
  // An engine's epochs last some 4 spacings: a hundred of them, looked at all along.
  for (const V& g : {V(0.0, -0.5), V(0.3, -0.5), V(2.0, 1.0)}) {
    Simulation simulation = make_simulation(falling(mixture_scene(49, 0.3, Boundary::walls), g), "general");
    for (int k = 1; k <= 400; ++k) {
      simulation.run_until(0.25 * k);
      const auto faults = simulation.check_invariants();
      ASSERT_TRUE(faults.empty()) << "g = " << g.transpose() << ", t = " << simulation.time() << ": " << faults.front();
    }
  }
}

// ------------------------------------------------------------------------------------------------ hard cases

TEST(Gravity, AnApexExactlyAtTheCeilingIsNoCollision) {
  // From the floor with 4 at g = 4: it rises by 2 and turns where it touches. All dyadic.
  for (const char* engine : engines_with_effects) {
    const Scene scene = falling(scene_of_placed(box_of(4.0, 3.0, Boundary::walls), {{{2.0, 0.5}, {0.0, 4.0}}}), {0.0, -4.0});
    const Ran ran = run(scene, engine, 100.0);
    EXPECT_EQ(ran.stopped, StopReason::time);
    const auto ceiling =
        std::count_if(ran.events.begin(), ran.events.end(), [](const Event& e) { return e.partner == wall_top; });
    EXPECT_EQ(ceiling, 0) << engine;
    EXPECT_EQ(ran.simulation.totals().wall, 50U) << engine;
    EXPECT_EQ(ran.simulation.state().velocities(1, 0), 4.0) << "at the floor again, at an even time";
  }
}

TEST(Gravity, AHairFasterOrSlowerHitsOrMissesTheCeiling) {
  for (const char* engine : engines_with_effects)
    for (const bool faster : {true, false}) {
      const double v = 4.0 * (faster ? 1 + 0x1p-40 : 1 - 0x1p-40);
      const Scene scene = falling(scene_of_placed(box_of(4.0, 3.0, Boundary::walls), {{{2.0, 0.5}, {0.0, v}}}), {0.0, -4.0});
      const Ran ran = run(scene, engine, 101.0);
      EXPECT_EQ(ran.simulation.totals().wall_impulse[3] > 0.0, faster) << engine;
      EXPECT_NEAR(energy_of(ran.simulation), v * v / 2 + 4.0 * 0.5, 1e-12);
    }
}

// A disk that rests hops by 2^-40 of its radius of 1/2, which takes 2.7e-6; heights are rounded at the size of the box, 4, a few
// times.
constexpr double invisible = 0x1p-41 + 16 * 0x1p-53 * 4.0;

TEST(Gravity, ADiskThatRestsOnTheFloorStaysThere) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = falling(scene_of_placed(box_of(4.0, 4.0, Boundary::walls), {{{2.0, 0.5}, {0.0, 0.0}}}), {0.0, -1.0});
    const Ran ran = run(scene, engine, 1.0);
    EXPECT_EQ(ran.stopped, StopReason::time) << engine;
    EXPECT_NEAR(ran.simulation.state().positions(1, 0), 0.5, invisible);
    EXPECT_EQ(ran.simulation.state().positions(0, 0), 2.0);
    EXPECT_NEAR(ran.simulation.totals().wall_impulse[2], 1.0, 1e-5) << "the floor carries its weight, but for the last hop";
  }
}

/// A disk in contact with one surface, or with two that are at right angles: along the normal of each it hops by itself.
struct Rest {
  const char* where;
  Scene scene;
  double hops;  ///< the energy of its hops, in m |g| radius 2^-40: the sum of |g . n| / |g|
};

std::vector<Rest> all_ways_to_rest() {
  const Box box = {{-4.0, 0.0}, {4.0, 8.0}, {Boundary::walls, Boundary::walls}};
  const auto one = [&](const V& r, const V& g) { return falling(scene_of_placed(box, {{r, {0.0, 0.0}}}), g); };
  const auto with = [](Scene scene, const std::vector<Obstacle>& obstacles) {
    scene.effects.obstacles = obstacles;
    return scene;
  };
  const auto segment = [](const V& from, const V& to) { return Obstacle(SegmentObstacle{from, to}); };
  const auto disk = [](const V& centre) { return Obstacle(DiskObstacle{centre, 0.5}); };
  const V down(0.0, -2.0);
  const double half = std::sqrt(0.5);
  Scene far = one({1e6, 0.5}, down);
  far.box = {{1e6 - 4.0, 0.0}, {1e6 + 4.0, 8.0}, box.boundary};
  return {{"on the floor", one({0.0, 0.5}, down), 1.0},
          {"at the ceiling", one({0.0, 7.5}, -down), 1.0},
          {"at the left wall", one({-3.5, 4.0}, {-2.0, 0.0}), 1.0},
          {"in a corner", one({3.5, 0.5}, {1.2, -1.6}), 1.4},
          {"far from the origin", far, 1.0},
          {"on a segment", with(one({0.0, 1.5}, down), {segment({-3.0, 1.0}, {3.0, 1.0})}), 1.0},
          {"in a groove", with(one({0.0, half}, down), {segment({-3.0, 3.0}, {0.0, 0.0}), segment({0.0, 0.0}, {3.0, 3.0})}),
           2 * half},
          {"between two fixed disks", with(one({0.0, 1.0 + half}, down), {disk({-half, 1.0}), disk({half, 1.0})}), 2 * half}};
}

TEST(Gravity, ADiskAtRestGainsTheEnergyOfOneHopOnce) {
  // 1e4 hops or more: an energy that rounding took or gave to one side would be another one by now.
  for (const char* engine : engines_with_effects)
    for (const Rest& rest : all_ways_to_rest()) {
      Simulation simulation = make_simulation(rest.scene, engine);
      const double energy = energy_of(simulation), hop = 2.0 * 0.5 * 0x1p-40;
      for (const double time : {0.001, 0.02}) {
        EXPECT_EQ(simulation.run_until(time), StopReason::time) << engine << ", " << rest.where;
        // Heights of some units of length are rounded to the eighth part of 2^-50 when the energy is added up, at g = 2.
        EXPECT_NEAR(energy_of(simulation) - energy, rest.hops * hop, 0.01 * hop + 0x1p-50 * 8.0) << engine << ", " << rest.where;
      }
      EXPECT_GT(simulation.totals().wall + simulation.totals().obstacle, 10'000U);
    }
}

TEST(Gravity, DisksThatRestOnEachOtherGainTheEnergyOfSomeHopsAndNoMore) {
  // A stack of three masses, and a pile whose upper disk drives the lower ones apart. Hops of the lower disks are handed on, and
  // come back at any speed: the floor and the walls take more than they give of what is above a few hops.
  const double hop = 0.5 * 2.0 * 0x1p-40;
  const Scene stack = scene_of_placed(
      box_of(8.0, 8.0, Boundary::walls),
      {{{4.0, 0.5}, {0.0, 0.0}, 0.5, 1.0}, {{4.0, 1.5}, {0.0, 0.0}, 0.5, 3.0}, {{4.0, 2.5}, {0.0, 0.0}, 0.5, 0.4}});
  const Scene pile = scene_of_placed({{0.0, 0.0}, {2.2, 8.0}, {Boundary::walls, Boundary::walls}},
                                     {{{0.5, 0.5}, {0.0, 0.0}}, {{1.7, 0.5}, {0.0, 0.0}}, {{1.1, 1.3}, {0.0, 0.0}}});
  for (const char* engine : engines_with_effects)
    for (const Scene& scene : {stack, pile}) {
      Simulation simulation = make_simulation(falling(scene, {0.0, -2.0}), engine);
      const double energy = energy_of(simulation);
      double mass = 0.0;
      for (const double m : simulation.disks().mass) mass += m;
      for (int k = 1; k <= 5; ++k) {
        EXPECT_EQ(simulation.run_until(0.004 * k), StopReason::time) << engine;
        EXPECT_LT(energy_of(simulation) - energy, 6.0 * mass * hop) << engine << ", " << simulation.totals().wall;
      }
    }
}

TEST(Gravity, BouncesKeepTheirEnergyToRounding) {
  // docs/numerics.md: in "general" the energy of a disk that meets walls alone is off by m g s at most, however often it bounces,
  // with s = 2^-57 L the step of its coordinate (of a disk that is alone). In "textbook" it takes a step of a random walk at
  // every bounce, of m u (g y + 4 v^2) at most, y being the coordinate and v the speed at the bounce: five standard deviations of
  // n such steps, equally distributed, are below 3 sqrt(n) of the longest.
  constexpr double u = 0x1p-53;
  constexpr std::uint64_t bounces = 40'000;
  struct Bounces {
    double length, floor, radius, height, g;
  };
  for (const Bounces& b :
       {Bounces{8.0, 0.0, 0.5, 1e-3, -2.0}, Bounces{8.3, 0.3, 0.37, 1.23e-3, -3.3}, Bounces{800.0, 0.0, 0.05, 1e-4, -1.0},
        Bounces{8.0, 0.0, 0.5, 1e-6, -2.0}, Bounces{8.0, 0.0, 0.5, 1e-3, 2.0}, Bounces{10.0, -1.3, 0.1, 8.2, -1.7}})
    for (const char* engine : engines_with_effects) {
      const double g = std::abs(b.g), v = std::sqrt(2.0 * g * b.height), middle = b.floor + b.length / 2.0;
      const double contact = b.g < 0.0 ? b.floor + b.radius : b.floor + b.length - b.radius;
      const V start(middle, contact + (b.g < 0.0 ? b.height : -b.height));
      const Box box = {{b.floor, b.floor}, {b.floor + b.length, b.floor + b.length}, {Boundary::walls, Boundary::walls}};
      Simulation simulation = make_simulation(falling(scene_of_placed(box, {{start, {0.0, 0.0}, b.radius}}), {0.0, b.g}), engine);
      const double energy = energy_of(simulation);
      simulation.run_until(static_cast<double>(bounces) * 2.0 * v / g);
      ASSERT_GT(simulation.totals().wall, bounces - 10);
      const double step = g * std::ldexp(b.length, -57);
      const double walk = 3.0 * std::sqrt(static_cast<double>(bounces)) * u * (g * std::abs(contact) + 4.0 * v * v);
      // What is reported is rounded: energies and coordinates, and the way since the epoch, of up to 8 box lengths.
      const double measured = 4.0 * u * (energy + g * (std::abs(contact) + 8.0 * b.length));
      EXPECT_NEAR(energy_of(simulation), energy, (engine == std::string("general") ? step : walk) + measured)
          << engine << ", box of " << b.length << ", " << b.height << " high";
    }
}

TEST(Gravity, AGasKeepsItsEnergyAsRoundingThatPrefersNoSideDoes) {
  // Of unequal masses, in a box whose length is no power of two. Each of two partners errs by m v u v and by m g u v T (the way
  // since the epoch, of which coordinates lose a digit), v some 6 and T some 4: 5 sqrt(n) of that.
  for (const char* engine : engines_with_effects) {
    Scene scene = falling(mixture_scene(16, 0.2, Boundary::walls), {0.0, -1.7});
    Simulation simulation = make_simulation(scene, engine);
    const double energy = energy_of(simulation);
    simulation.run_until(1e9, {.collisions = 50'000});
    EXPECT_NEAR(energy_of(simulation), energy, 5.0 * std::sqrt(50'000.0) * 0x1p-53 * (6.0 * 6.0 + 1.7 * 6.0 * 4.0)) << engine;
  }
}

TEST(Gravity, ADiskSlidesAlongTheFloor) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = falling(scene_of_placed(box_of(64.0, 4.0, Boundary::walls), {{{1.0, 0.5}, {32.0, 0.0}}}), {0.0, -1.0});
    const Ran ran = run(scene, engine, 1.0);
    EXPECT_EQ(ran.stopped, StopReason::time) << engine;
    EXPECT_NEAR(ran.simulation.state().positions(0, 0), 33.0, 1e-9) << "4e5 lines, each rounded at 33";
    EXPECT_NEAR(ran.simulation.state().positions(1, 0), 0.5, invisible);
    EXPECT_EQ(ran.simulation.state().velocities(0, 0), 32.0);
  }
}

TEST(Gravity, PullsADiskExactlyIntoACorner) {
  // Along the diagonal, from rest: both walls are met at one instant, for ever.
  for (const char* engine : engines_with_effects) {
    const Scene scene = falling(scene_of_placed(box_of(4.0, 4.0, Boundary::walls), {{{2.5, 2.5}, {0.0, 0.0}}}), {-4.0, -4.0});
    const Ran ran = run(scene, engine, 2.0 * 16 + 1.0);
    EXPECT_EQ(ran.stopped, StopReason::time) << engine;
    ASSERT_GE(ran.events.size(), 32U);
    for (std::size_t k = 0; k + 1 < ran.events.size(); k += 2) {
      EXPECT_EQ(ran.events[k].time, ran.events[k + 1].time);
      EXPECT_NE(ran.events[k].partner, ran.events[k + 1].partner);
    }
    const State end = ran.simulation.state();
    EXPECT_EQ(end.positions(0, 0), end.positions(1, 0)) << "one path for both coordinates";
  }
}

TEST(Gravity, MayPullUpwardsAndToTheSide) {
  // The mirror image of a fall is a fall in the mirror.
  for (const char* engine : engines_with_effects) {
    const Box box = {{-4.0, -4.0}, {4.0, 4.0}, {Boundary::walls, Boundary::walls}};
    const auto seen = [&](const Eigen::Matrix2d& mirror) {
      std::vector<Placed> disks = {
          {{-1.0, 2.0}, {0.5, -0.25}}, {{1.25, 1.0}, {-0.25, 0.0}, 0.75, 2.0}, {{0.0, -2.0}, {0.0, 1.0}}};
      for (Placed& disk : disks) disk.r = mirror * disk.r, disk.v = mirror * disk.v;
      const Ran ran = run(falling(scene_of_placed(box, disks), mirror * V(0.25, -1.0)), engine, 8.0);
      EXPECT_GT(ran.simulation.totals().pair, 2U);
      return Eigen::Matrix2Xd(mirror * ran.simulation.state().positions);
    };
    const Eigen::Matrix2Xd down = seen(Eigen::Matrix2d::Identity());
    // A few collisions, each of which may make an error of 1e-15 ten times larger.
    EXPECT_LE((down - seen(Eigen::Vector2d(1.0, -1.0).asDiagonal())).cwiseAbs().maxCoeff(), 1e-9) << engine;
    EXPECT_LE((down - seen(Eigen::Vector2d(-1.0, 1.0).asDiagonal())).cwiseAbs().maxCoeff(), 1e-9) << engine;
  }
}

TEST(Gravity, AMassRatioOf1e12StaysInTheBox) {
  // A light disk between the floor and one that is 1e12 times heavier and falls on it: driven faster and faster, it carries.
  for (const char* engine : engines_with_effects) {
    const Scene scene = falling(scene_of_placed(box_of(2.0, 8.0, Boundary::walls),
                                                {{{1.0, 0.5}, {0.0, 0.0}, 0.5, 1e-6}, {{1.0, 4.0}, {0.0, 0.0}, 0.5, 1e6}}),
                                {0.0, -1.0});
    Simulation simulation = make_simulation(scene, engine);
    const double energy = energy_of(simulation);
    const StopReason stopped = simulation.run_until(2.0, {.collisions = 100'000});
    EXPECT_TRUE(stopped == StopReason::time || stopped == StopReason::collisions) << engine << ": " << to_string(stopped);
    EXPECT_NEAR(energy_of(simulation) / energy, 1.0, 1e-10);
    EXPECT_GE(simulation.state().positions.row(1).minCoeff(), 0.5 - 1e-12);
    EXPECT_GE(smallest_distance(scene.box, simulation.state().positions), 1.0 - 1e-12);
  }
}

}  // namespace
}  // namespace carom::test
