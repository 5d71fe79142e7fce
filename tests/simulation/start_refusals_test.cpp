// Starts and schedules that a program may put together and that no run could survive.

#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

TEST(StartRefusals, SpeedsWhoseSquaresOverflowOrVanish) {
  for (const double speed : {1e151, 1e-151}) {
    Scene scene = gas_scene(4, 0.1, Boundary::walls);
    scene.species.front().velocities = FixedSpeed{speed};
    EXPECT_THROW(make_simulation(scene), SceneError) << speed;
  }
}

TEST(StartRefusals, EffectsOfNumbersThatAreNoneOrOutOfRange) {
  using Number = std::function<double&(Effects&)>;
  const auto within = [](auto& optional) -> double& { return optional ? *optional : optional.emplace(); };
  Scene scene = gas_scene(4, 0.1, Boundary::walls);
  scene.effects.obstacles = {DiskObstacle{scene.box.upper, 0.01}};
  const std::vector<std::pair<Number, std::vector<double>>> numbers = {
      {[&](Effects& e) -> double& { return within(e.collision.restitution); }, {-0.1, 1.1}},
      {[&](Effects& e) -> double& { return within(e.collision.roughness); }, {-1.1, 1.1}},
      {[&](Effects& e) -> double& { return within(e.collision.elastic_below); }, {-1.0}},
      {[](Effects& e) -> double& { return e.gravity.emplace().acceleration[1]; }, {}},
      {[&](Effects& e) -> double& { return within(e.walls[2].restitution); }, {-0.1, 1.1}},
      {[&](Effects& e) -> double& { return within(e.walls[2].temperature); }, {0.0, -1.0}},
      {[&](Effects& e) -> double& { return within(e.walls[2].velocity); }, {}},
      {[&](Effects& e) -> double& { return e.walls[2].load = 1.0, within(e.walls[2].mass); }, {0.0, -1.0}},
      {[&](Effects& e) -> double& { return e.walls[2].mass = 1.0, within(e.walls[2].load); }, {-1.0}},
      {[](Effects& e) -> double& { return std::get<DiskObstacle>(e.obstacles[0]).radius; }, {0.0, -1.0}},
      {[](Effects& e) -> double& { return std::get<DiskObstacle>(e.obstacles[0]).centre[0]; }, {}},
      {[](Effects& e) -> double& { return e.growth.emplace().rate; }, {-1.0}},
      {[&](Effects& e) -> double& { return within(e.growth.emplace().packing_fraction); }, {0.0, 1.1}},
      {[&](Effects& e) -> double& { return within(e.growth.emplace().reduced_pressure); }, {0.0}},
      {[](Effects& e) -> double& {
         return e.thermostat = Thermostat{1.0, 1.0}, e.thermostat->temperature;
       },
       {0.0, -1.0}},
      {[](Effects& e) -> double& {
         return e.thermostat = Thermostat{1.0, 1.0}, e.thermostat->rate;
       },
       {-1.0}},
      {[](Effects& e) -> double& { return e.shear.emplace().rate; }, {}},
      {[](Effects& e) -> double& {
         return e.square_well = SquareWell{1.5, 1.0}, e.square_well->width;
       },
       {1.0, 0.5}},
      {[](Effects& e) -> double& {
         return e.square_well = SquareWell{1.5, 1.0}, e.square_well->depth;
       },
       {}},
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    std::vector<double> wrong = numbers[k].second;
    wrong.insert(wrong.end(), {nan, infinity, -infinity});
    for (const double value : wrong) {
      Scene spoilt = scene;
      numbers[k].first(spoilt.effects) = value;
      EXPECT_THROW(make_simulation(spoilt), SceneError) << k << " " << value;
    }
  }
}

TEST(JammedRun, TwoDisksThatFillTheWayFromWallToWallEndWithAWord) {
  Scene scene;
  scene.box = {{0.0, 0.0}, {2.0, 1.5}, {Boundary::walls, Boundary::walls}};
  Species row;
  row.name = "row";
  row.count = 2;
  row.radius = 0.5;
  row.mass = 1.0;
  row.positions = ListedPositions{{{0.5, 0.75}, {1.5, 0.75}}};
  row.velocities = ListedVelocities{{{1.0, 0.0}, {0.0, 0.0}}};
  scene.species = {row};
  scene.run.time = 1.0;
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::jammed);
  EXPECT_EQ(simulation.time(), 0.0);
}

}  // namespace
}  // namespace carom::test
