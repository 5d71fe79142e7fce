// The grid against the search of all pairs: the same trajectory to the last bit, whatever the box, the disks and the step.

#include "stepper/any_disks.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace carom::test {
namespace {

void expect_same(const Scene& scene, const State& start, double dt, double time, const std::string& what) {
  Simulation grid = make_simulation(scene, start, FixedStep{"grid", dt});
  Simulation guarded = make_simulation(scene, start, FixedStep{"guarded", dt});
  grid.record_events(true);
  guarded.record_events(true);
  for (int part = 1; part <= 4; ++part) {
    grid.run_until(time * part / 4);
    guarded.run_until(time * part / 4);
  }
  EXPECT_EQ(grid.totals().pair, guarded.totals().pair) << what;
  EXPECT_EQ(grid.totals().wall, guarded.totals().wall) << what;
  EXPECT_EQ(grid.totals().virial, guarded.totals().virial) << what;
  EXPECT_TRUE(same_bits(grid.state(), guarded.state())) << what;
  const std::vector<Event> events = grid.take_events(), twins = guarded.take_events();
  ASSERT_EQ(events.size(), twins.size()) << what;
  for (std::size_t k = 0; k < events.size(); ++k) {
    ASSERT_EQ(events[k].time, twins[k].time) << what;
    ASSERT_EQ(events[k].disk, twins[k].disk) << what;
    ASSERT_EQ(events[k].partner, twins[k].partner) << what;
  }
}

void expect_same(const Scene& scene, double dt, double time, const std::string& what) {
  expect_same(scene, make_simulation(scene).state(), dt, time, what);
}

TEST(Grid, IsTheSearchOfAllPairsAtEveryDensityAndStep) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    for (const double packing_fraction : {0.05, 0.3, 0.7}) {
      for (const double dt : {0.001, 0.02, 0.3, 5.0}) {
        expect_same(gas_scene(60, packing_fraction, boundary), dt, 100 * dt, fmt::format("{} {}", packing_fraction, dt));
        expect_same(mixture_scene(60, 0.8 * packing_fraction, boundary), dt, 100 * dt,
                    fmt::format("mixture {} {}", packing_fraction, dt));
      }
    }
  }
}

TEST(Grid, IsTheSearchOfAllPairsInBoxesOfOneTwoAndThreeCells) {
  for (const Boundary x : {Boundary::walls, Boundary::periodic}) {
    for (const Boundary y : {Boundary::walls, Boundary::periodic}) {
      for (const double length : {2.2, 3.1, 4.4, 5.3, 7.0}) {
        Scene scene =
            scene_of(box_of(length, 2.0 * length, x, y), {species_of(4, 0.4, 1.0, SquareLattice{}, MaxwellVelocities{1.0})});
        for (const double dt : {0.003, 0.1}) expect_same(scene, dt, 300 * dt, fmt::format("{} {}", length, dt));
      }
    }
  }
}

TEST(Grid, IsTheSearchOfAllPairsForSizesFarApart) {
  expect_same(two_sizes_scene(300, 0.3, Boundary::periodic), 0.01, 2.0, "periodic");
  expect_same(two_sizes_scene(300, 0.3, Boundary::walls), 0.05, 5.0, "walls");
}

TEST(Grid, IsTheSearchOfAllPairsWhenOneDiskIsSuddenlyFast) {
  Scene scene = gas_scene(64, 0.3, Boundary::periodic);
  State start = make_simulation(scene).state();
  start.velocities.col(17) *= 1000.0;
  expect_same(scene, start, 0.001, 0.5, "fast disk");
}

TEST(Grid, HoldsForNoDiskAndOne) {
  for (const std::int64_t disks : {0, 1}) {
    Scene scene = scene_of(square_box(4.0, Boundary::periodic), {species_of(disks, 0.5, 1.0, SquareLattice{}, FixedSpeed{1.0})});
    expect_same(scene, 0.1, 10.0, fmt::format("{} disks", disks));
  }
}

RC_GTEST_PROP(PropertyGrid, IsTheSearchOfAllPairsForAnyDisks, ()) {
  const System system = any_disks(2.0);
  Scene scene = scene_of(system.box, {});
  scene.effects.collision.rule = *rc::gen::arbitrary<bool>() ? CollisionRule::specular : CollisionRule::reversal;
  for (std::size_t i = 0; i < system.disks.count(); ++i)
    scene.species.push_back(species_of(1, system.disks.radius[i], system.disks.mass[i], RandomPositions{}, AtRest{}));
  RC_PRE(scene.packing_fraction() < 1.0);
  const double dt = std::pow(10.0, any_number(-3.0, 1.0));
  expect_same(scene, system.state, dt, 50 * dt, "any");
}

}  // namespace
}  // namespace carom::test
