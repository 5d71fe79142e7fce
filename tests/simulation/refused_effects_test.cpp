// Effects that no file and no program may ask for.

#include "simulation/refused_cases.hpp"

#include <string>
#include <vector>

namespace carom::test {
namespace {

std::vector<RefusedCase> refused_effects() {
  const std::string walls = "walls", periodic = "periodic";
  const auto obstacle = [](auto shape) { return [shape](Scene& s) { s.effects.obstacles = {shape}; }; };
  const auto shear = [](Scene& s) { in(s.effects.shear).rate = 0.1; };
  return {
      {"RestitutionAboveOne", walls, {"collision.restitution=1.5"}, [](Scene& s) { s.effects.collision.restitution = 1.5; }},
      {"RoughnessBelowMinusOne", walls, {"collision.roughness=-1.5"}, [](Scene& s) { s.effects.collision.roughness = -1.5; }},
      {"RoughnessWithReversal",
       walls,
       {"collision.rule=reversal", "collision.roughness=0.5"},
       [](Scene& s) {
         s.effects.collision = {CollisionRule::reversal, {}, 0.5, {}};
       }},
      {"ElasticBelowNegative",
       walls,
       {"collision.elastic_below={ time = -1.0 }"},
       [](Scene& s) { s.effects.collision.elastic_below = -1.0; }},
      {"GravityOfNaN",
       walls,
       {"gravity.acceleration=[0.0, nan]"},
       [](Scene& s) {
         in(s.effects.gravity).acceleration = {0.0, not_a_number};
       }},
      {"GravityOnAPeriodicAxis",
       periodic,
       {"gravity.acceleration=[0.0, -1.0]"},
       [](Scene& s) {
         in(s.effects.gravity).acceleration = {0.0, -1.0};
       }},
      {"WallOfAPeriodicBox", periodic, {"walls.left={ velocity = 0.1 }"}, [](Scene& s) { s.effects.walls[0].velocity = 0.1; }},
      {"WallRestitutionAboveOne",
       walls,
       {"walls.left={ restitution = 1.5 }"},
       [](Scene& s) { s.effects.walls[0].restitution = 1.5; }},
      {"WallTemperatureZero",
       walls,
       {"walls.left={ temperature = 0.0 }"},
       [](Scene& s) { s.effects.walls[0].temperature = 0.0; }},
      {"WallVelocityInfinite",
       walls,
       {"walls.left={ velocity = inf }"},
       [](Scene& s) { s.effects.walls[0].velocity = infinite_number; }},
      {"ThermalWallWithRestitution",
       walls,
       {"walls.right={ temperature = 1.0, restitution = 0.5 }"},
       [](Scene& s) { s.effects.walls[1].temperature = 1.0, s.effects.walls[1].restitution = 0.5; }},
      {"ThermalPiston",
       walls,
       {"walls.top={ temperature = 1.0, mass = 1.0, load = 1.0 }"},
       [](Scene& s) {
         s.effects.walls[3] = {{}, 1.0, {}, 1.0, 1.0};
       }},
      {"MovingPiston",
       walls,
       {"walls.top={ velocity = 0.1, mass = 1.0, load = 1.0 }"},
       [](Scene& s) {
         s.effects.walls[3] = {{}, {}, 0.1, 1.0, 1.0};
       }},
      {"PistonWithoutLoad", walls, {"walls.top={ mass = 1.0 }"}, [](Scene& s) { s.effects.walls[3].mass = 1.0; }},
      {"LoadWithoutPiston", walls, {"walls.top={ load = 1.0 }"}, [](Scene& s) { s.effects.walls[3].load = 1.0; }},
      {"PistonMassZero",
       walls,
       {"walls.top={ mass = 0.0, load = 1.0 }"},
       [](Scene& s) { s.effects.walls[3] = {.mass = 0.0, .load = 1.0}; }},
      {"LoadNegative",
       walls,
       {"walls.top={ mass = 1.0, load = -1.0 }"},
       [](Scene& s) { s.effects.walls[3] = {.mass = 1.0, .load = -1.0}; }},
      {"WallsThatMeet", walls, {"walls.top={ velocity = -0.4 }"}, [](Scene& s) { s.effects.walls[3].velocity = -0.4; }},
      {"WallIntoAnObstacle",
       walls,
       {"walls.left={ velocity = 0.1 }", "obstacles=[{ disk = { centre = [-0.8, 0.0], radius = 0.1 } }]"},
       [](Scene& s) {
         s.effects.walls[0].velocity = 0.1;
         s.effects.obstacles = {DiskObstacle{{-0.8, 0.0}, 0.1}};
       }},
      {"ObstacleRadiusNegative",
       walls,
       {"obstacles=[{ disk = { centre = [0.0, 0.0], radius = -0.1 } }]"},
       obstacle(DiskObstacle{{0.0, 0.0}, -0.1})},
      {"ObstacleAtNaN",
       walls,
       {"obstacles=[{ disk = { centre = [nan, 0.0], radius = 0.1 } }]"},
       obstacle(DiskObstacle{{not_a_number, 0.0}, 0.1})},
      {"SegmentToInfinity",
       walls,
       {"obstacles=[{ segment = { from = [0.0, 0.0], to = [0.0, inf] } }]"},
       obstacle(SegmentObstacle{{0.0, 0.0}, {0.0, infinite_number}})},
      {"SegmentOfNoLength",
       walls,
       {"obstacles=[{ segment = { from = [0.1, 0.0], to = [0.1, 0.0] } }]"},
       obstacle(SegmentObstacle{{0.1, 0.0}, {0.1, 0.0}})},
      {"SegmentOutside",
       walls,
       {"obstacles=[{ segment = { from = [0.1, 0.0], to = [1.1, 0.0] } }]"},
       obstacle(SegmentObstacle{{0.1, 0.0}, {1.1, 0.0}})},
      {"ObstacleOutside",
       walls,
       {"obstacles=[{ disk = { centre = [2.0, 0.0], radius = 0.1 } }]"},
       obstacle(DiskObstacle{{2.0, 0.0}, 0.1})},
      {"ObstacleInTheWall",
       walls,
       {"obstacles=[{ disk = { centre = [0.95, 0.0], radius = 0.1 } }]"},
       obstacle(DiskObstacle{{0.95, 0.0}, 0.1})},
      {"ObstacleThatMeetsItsImage",
       periodic,
       {"obstacles=[{ disk = { centre = [0.0, 0.0], radius = 1.0 } }]"},
       obstacle(DiskObstacle{{0.0, 0.0}, 1.0})},
      {"DiskUponAnObstacle",
       walls,
       {"obstacles=[{ disk = { centre = [0.5, 0.4], radius = 0.1 } }]"},
       obstacle(DiskObstacle{{0.5, 0.4}, 0.1})},
      {"DiskAcrossASegment",
       walls,
       {"obstacles=[{ segment = { from = [-0.5, -1.0], to = [-0.5, 0.0] } }]"},
       obstacle(SegmentObstacle{{-0.5, -1.0}, {-0.5, 0.0}})},
      {"GrowthRateNegative",
       periodic,
       {"growth={ rate = -1.0, until = { pressure = 10.0 } }"},
       [](Scene& s) { s.effects.growth = Growth{.rate = -1.0, .reduced_pressure = 10.0}; }},
      {"GrowthUntilTwo",
       periodic,
       {"growth={ rate = 0.1, until = { pressure = 10.0, packing_fraction = 0.5 } }"},
       [](Scene& s) {
         s.effects.growth = Growth{0.1, 0.5, 10.0};
       }},
      {"GrowthUntilPressureZero",
       periodic,
       {"growth={ rate = 0.1, until = { pressure = 0.0 } }"},
       [](Scene& s) { s.effects.growth = Growth{.rate = 0.1, .reduced_pressure = 0.0}; }},
      {"GrowthWithoutAnEnd",
       periodic,
       {"growth.rate=0.1", "run={ collisions = 1000 }"},
       [](Scene& s) { s.effects.growth = Growth{.rate = 0.1}, s.run.time.reset(), s.run.collisions = 1000; }},
      {"GrowthPastOne",
       periodic,
       {"growth={ rate = 0.1, until = { packing_fraction = 1.5 } }"},
       [](Scene& s) { s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 1.5}; }},
      {"GrowthPastClosePacking",
       periodic,
       {"growth={ rate = 0.1, until = { packing_fraction = 0.95 } }", "disks.1.radius=0.05"},
       [](Scene& s) { s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.95}, s.species[1].radius = 0.05; }},
      {"GrowthAlreadyThere",
       periodic,
       {"growth={ rate = 0.1, until = { packing_fraction = 0.01 } }"},
       [](Scene& s) { s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.01}; }},
      {"GrowthWiderThanTheBox",
       periodic,
       {"growth={ rate = 0.1, until = { packing_fraction = 0.95 } }", "disks.0.count=1", "disks.0.radius=1e-3",
        "disks.1.positions=[[0.0, 0.0]]", "disks.1.velocities=[[0.0, 0.0]]"},
       [](Scene& s) {
         s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.95};
         s.species[0].count = 1, s.species[0].radius = 1e-3, s.species[1].count = 1;
         s.species[1].positions = ListedPositions{{{0.0, 0.0}}}, s.species[1].velocities = ListedVelocities{{{0.0, 0.0}}};
       }},
      {"GrowthFillsTheBoxInTime", walls, {"growth={ rate = 10.0 }"}, [](Scene& s) { s.effects.growth = Growth{.rate = 10.0}; }},
      {"MassTooLarge", walls, {"disks.0.mass=1e301"}, [](Scene& s) { s.species[0].mass = 1e301; }},
      {"WallRunsAway", walls, {"walls.top={ velocity = 1e100 }"}, [](Scene& s) { s.effects.walls[3].velocity = 1e100; }},
      {"LoadTooLarge",
       walls,
       {"walls.top={ mass = 1.0, load = 1e308 }"},
       [](Scene& s) { s.effects.walls[3] = {.mass = 1.0, .load = 1e308}; }},
      {"PistonTooLight",
       walls,
       {"walls.top={ mass = 1e-20, load = 1e-10 }"},
       [](Scene& s) { s.effects.walls[3] = {.mass = 1e-20, .load = 1e-10}; }},
      {"WallTooHot", walls, {"walls.top={ temperature = 1e305 }"}, [](Scene& s) { s.effects.walls[3].temperature = 1e305; }},
      {"GravityTooStrong",
       walls,
       {"gravity.acceleration=[0.0, -1e305]"},
       [](Scene& s) {
         in(s.effects.gravity).acceleration = {0.0, -1e305};
       }},
      {"ShearTooFast", periodic, {"shear.rate=1e30"}, [](Scene& s) { in(s.effects.shear).rate = 1e30; }},
      {"ThermostatTooFast",
       periodic,
       {"thermostat={ temperature = 1.0, rate = 1e20 }"},
       [](Scene& s) {
         s.effects.thermostat = Thermostat{1.0, 1e20};
       }},
      {"WellTooDeep",
       periodic,
       {"square_well={ width = 1.5, depth = 1e305 }"},
       [](Scene& s) {
         s.effects.square_well = SquareWell{1.5, 1e305};
       }},
      {"BoxFarAway",
       periodic,
       {"box.x=[1e15, 1000000000000002.0]", "disks.1.positions=random", "disks.1.count=2"},
       [](Scene& s) { s.box.lower[0] = 1e15, s.box.upper[0] = 1000000000000002.0, s.species[1].positions = RandomPositions{}; }},
      {"ObservedTooOften",
       walls,
       {"observe.temperature={ every = 1e-300 }"},
       [](Scene& s) { s.observe = {observable("temperature")}, s.observe[0].every = 1e-300; }},
      {"SampledTooOften",
       walls,
       {"run={ collisions = 100, sample_every = 1e-300 }"},
       [](Scene& s) { s.run.time.reset(), s.run.collisions = 100, s.run.sample_every = 1e-300; }},
      {"GrowthAndEquilibrate",
       periodic,
       {"growth={ rate = 0.1, until = { packing_fraction = 0.5 } }", "run.equilibrate={ time = 1.0 }"},
       [](Scene& s) {
         s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.5}, s.run.equilibrate = Run::Equilibrate{{}, 1.0};
       }},
      {"GrowthAndAMovingWall",
       walls,
       {"growth={ rate = 0.1, until = { packing_fraction = 0.5 } }", "walls.top={ velocity = 0.1 }"},
       [](Scene& s) { s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.5}, s.effects.walls[3].velocity = 0.1; }},
      {"GrowthAndAPiston",
       walls,
       {"growth={ rate = 0.1, until = { packing_fraction = 0.5 } }", "walls.top={ mass = 1.0, load = 1.0 }"},
       [](Scene& s) {
         s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.5}, s.effects.walls[3] = {.mass = 1.0, .load = 1.0};
       }},
      {"ThermostatTemperatureZero",
       periodic,
       {"thermostat={ temperature = 0.0, rate = 1.0 }"},
       [](Scene& s) {
         s.effects.thermostat = Thermostat{0.0, 1.0};
       }},
      {"ThermostatRateNegative",
       periodic,
       {"thermostat={ temperature = 1.0, rate = -1.0 }"},
       [](Scene& s) {
         s.effects.thermostat = Thermostat{1.0, -1.0};
       }},
      {"ShearOfNaN", periodic, {"shear.rate=nan"}, [](Scene& s) { in(s.effects.shear).rate = not_a_number; }},
      {"ShearBetweenWalls", walls, {"shear.rate=0.1"}, shear},
      {"ShearWithGravity",
       periodic,
       {"shear.rate=0.1", "gravity.acceleration=[0.0, 0.0]"},
       [=](Scene& s) { shear(s), in(s.effects.gravity); }},
      {"ShearWithObstacles",
       periodic,
       {"shear.rate=0.1", "obstacles=[{ disk = { centre = [0.0, 0.0], radius = 0.1 } }]"},
       [=](Scene& s) {
         shear(s), obstacle(DiskObstacle{{0.0, 0.0}, 0.1})(s);
       }},
      {"ShearWithGrowth",
       periodic,
       {"shear.rate=0.1", "growth={ rate = 0.1, until = { packing_fraction = 0.5 } }"},
       [=](Scene& s) { shear(s), s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.5}; }},
      {"ShearWithWells",
       periodic,
       {"shear.rate=0.1", "square_well={ width = 1.5, depth = 1.0 }"},
       [=](Scene& s) {
         shear(s), s.effects.square_well = SquareWell{1.5, 1.0};
       }},
      {"WellOfWidthOne",
       periodic,
       {"square_well={ width = 1.0, depth = 1.0 }"},
       [](Scene& s) {
         s.effects.square_well = SquareWell{1.0, 1.0};
       }},
      {"WellOfOneUlp",
       periodic,
       {"square_well={ width = 1.0000000000000002, depth = 1.0 }"},
       [](Scene& s) {
         s.effects.square_well = SquareWell{0x1.0000000000001p0, 1.0};
       }},
      {"WellDepthOfNaN",
       periodic,
       {"square_well={ width = 1.5, depth = nan }"},
       [](Scene& s) {
         s.effects.square_well = SquareWell{1.5, not_a_number};
       }},
      {"WellTooWide",
       periodic,
       {"square_well={ width = 5.5, depth = 1.0 }"},
       [](Scene& s) {
         s.effects.square_well = SquareWell{5.5, 1.0};
       }},
      {"WellsWithGrowth",
       periodic,
       {"square_well={ width = 1.5, depth = 1.0 }", "growth={ rate = 0.1, until = { packing_fraction = 0.5 } }"},
       [](Scene& s) {
         s.effects.square_well = SquareWell{1.5, 1.0}, s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.5};
       }},
  };
}

INSTANTIATE_TEST_SUITE_P(Effects, FileAndProgramChecks, testing::ValuesIn(refused_effects()), name_of);

}  // namespace
}  // namespace carom::test
