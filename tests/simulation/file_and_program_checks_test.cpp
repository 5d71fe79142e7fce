// What the reader of files refuses, every way to make a simulation refuses in the same words: each case is a change of a file and
// the same change of a Scene.

#include "support/refusal.hpp"
#include "support/scenes.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

using testing::HasSubstr;

/// Two species in [-1, 1] x [-1, 1]; the second is listed.
std::string base_text(const std::string& boundary) {
  return "[box]\nx = [-1.0, 1.0]\ny = [-1.0, 1.0]\nboundary = \"" + boundary +
         "\"\n[[disks]]\ncount = 8\nradius = 0.05\nmass = 1.0\npositions = \"random\"\nvelocities = { uniform = 1.0 }\n"
         "[[disks]]\nradius = 0.1\nmass = 2.0\npositions = [[0.5, 0.5], [-0.5, -0.5]]\nvelocities = [[1.0, 0.0], [0.0, 1.0]]\n"
         "[collision]\nrule = \"specular\"\n[run]\ntime = 5.0\n";
}

struct Case {
  std::string name;
  std::string boundary;
  std::vector<std::string> overrides;  ///< of the file
  std::function<void(Scene&)> change;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

template <class Kind>
Kind& in(std::optional<Kind>& effect) {
  return effect ? *effect : effect.emplace();
}

ObservableRequest observable(const std::string& name) {
  ObservableRequest request;
  request.name = name;
  return request;
}

std::string numbers_up_to(int last) {
  std::string text = "1.0";
  for (int k = 2; k <= last; ++k) text += ", " + std::to_string(k) + ".0";
  return text;
}

const double not_a_number = std::numeric_limits<double>::quiet_NaN(), infinite_number = std::numeric_limits<double>::infinity();

std::vector<Case> cases() {
  const std::string walls = "walls", periodic = "periodic";
  const auto obstacle = [](auto shape) { return [shape](Scene& s) { s.effects.obstacles = {shape}; }; };
  const auto observe = [](const std::string& name) { return [name](Scene& s) { s.observe = {observable(name)}; }; };
  const auto shear = [](Scene& s) { in(s.effects.shear).rate = 0.1; };
  return {
      // ------------------------------------------------------------------------------------------------------ the box
      {"BoxReversed", walls, {"box.x=[1.0, -1.0]"}, [](Scene& s) { std::swap(s.box.lower[0], s.box.upper[0]); }},
      {"BoxOfNaN", walls, {"box.y=[nan, 1.0]"}, [](Scene& s) { s.box.lower[1] = not_a_number; }},
      {"BoxWithoutEnd", walls, {"box.y=[-1.0, inf]"}, [](Scene& s) { s.box.upper[1] = infinite_number; }},
      {"BoxTooLarge",
       walls,
       {"box.x=[-1.0, 1e200]", "box.y=[-1.0, 1e200]"},
       [](Scene& s) {
         s.box.upper = {1e200, 1e200};
       }},
      // ------------------------------------------------------------------------------------------------------ disks
      {"CountNegative", walls, {"disks.0.count=-3"}, [](Scene& s) { s.species[0].count = -3; }},
      {"CountTooLarge", walls, {"disks.0.count=2147483648"}, [](Scene& s) { s.species[0].count = 2147483648; }},
      {"CountsTooLargeTogether", walls, {"disks.0.count=2147483647"}, [](Scene& s) { s.species[0].count = 2147483647; }},
      {"NamesAlike",
       walls,
       {"disks.0.name=gas", "disks.1.name=gas"},
       [](Scene& s) { s.species[0].name = s.species[1].name = "gas"; }},
      {"RadiusNegative", walls, {"disks.0.radius=-0.03"}, [](Scene& s) { s.species[0].radius = -0.03; }},
      {"RadiusZero", walls, {"disks.1.radius=0.0"}, [](Scene& s) { s.species[1].radius = 0.0; }},
      {"RadiiTooFew",
       walls,
       {"disks.0.radius=[0.05, 0.06]"},
       [](Scene& s) {
         s.species[0].radii = {0.05, 0.06};
       }},
      {"MassesTooMany",
       walls,
       {"disks.1.mass=[1.0, 1.0, 1.0]"},
       [](Scene& s) {
         s.species[1].masses = {1.0, 1.0, 1.0};
       }},
      {"OneRadiusNegative",
       walls,
       {"disks.1.radius=[0.1, -0.1]"},
       [](Scene& s) {
         s.species[1].radii = {0.1, -0.1};
       }},
      {"OneRadiusTooLarge",
       walls,
       {"disks.1.radius=[0.1, 1.5]"},
       [](Scene& s) {
         s.species[1].radii = {0.1, 1.5};
       }},
      {"OneMassOfNaN",
       walls,
       {"disks.1.mass=[nan, 1]"},
       [](Scene& s) {
         s.species[1].masses = {not_a_number, 1.0};
       }},
      {"OneMassTooSmall",
       walls,
       {"disks.1.mass=[1e-320, 1]"},
       [](Scene& s) {
         s.species[1].masses = {1e-320, 1.0};
       }},
      {"MassOfNaN", walls, {"disks.0.mass=nan"}, [](Scene& s) { s.species[0].mass = not_a_number; }},
      {"MassInfinite", walls, {"disks.0.mass=inf"}, [](Scene& s) { s.species[0].mass = infinite_number; }},
      {"UniformNegative",
       walls,
       {"disks.0.velocities.uniform=-1.0"},
       [](Scene& s) { s.species[0].velocities = UniformVelocities{-1.0}; }},
      {"TemperatureNegative",
       walls,
       {"disks.0.velocities={ temperature = -1.0 }"},
       [](Scene& s) { s.species[0].velocities = MaxwellVelocities{-1.0}; }},
      {"SpeedOfNaN",
       walls,
       {"disks.0.velocities={ speed = nan }"},
       [](Scene& s) { s.species[0].velocities = FixedSpeed{not_a_number}; }},
      {"PositionsTooFew", walls, {"disks.1.count=3"}, [](Scene& s) { s.species[1].count = 3; }},
      {"PositionOfNaN",
       walls,
       {"disks.1.positions=[[0.5, nan], [-0.5, -0.5]]"},
       [](Scene& s) { std::get<ListedPositions>(s.species[1].positions).values[0][1] = not_a_number; }},
      {"VelocitiesTooFew",
       walls,
       {"disks.1.velocities=[[1.0, 0.0]]"},
       [](Scene& s) { std::get<ListedVelocities>(s.species[1].velocities).values.pop_back(); }},
      {"VelocityInfinite",
       walls,
       {"disks.1.velocities=[[1.0, 0.0], [inf, 0.0]]"},
       [](Scene& s) { std::get<ListedVelocities>(s.species[1].velocities).values[1][0] = infinite_number; }},
      {"TooWideForTheWalls", walls, {"disks.0.radius=1.1"}, [](Scene& s) { s.species[0].radius = 1.1; }},
      {"TouchesItsOwnImage", periodic, {"disks.0.radius=1.0"}, [](Scene& s) { s.species[0].radius = 1.0; }},
      {"InTheWall",
       walls,
       {"disks.1.positions=[[0.5, 0.5], [0.96, 0.0]]"},
       [](Scene& s) {
         s.species[1].positions = ListedPositions{{{0.5, 0.5}, {0.96, 0.0}}};
       }},
      {"OutsideAPeriodicBox",
       periodic,
       {"disks.1.positions=[[0.5, 0.5], [1.5, 0.0]]"},
       [](Scene& s) {
         s.species[1].positions = ListedPositions{{{0.5, 0.5}, {1.5, 0.0}}};
       }},
      {"DenserThanPossible", walls, {"disks.0.radius=0.7"}, [](Scene& s) { s.species[0].radius = 0.7; }},
      {"DenserThanRandom",
       walls,
       {"disks.0.count=300", "disks.1.positions=random", "disks.1.count=0", "disks.1.velocities=rest"},
       [](Scene& s) {
         s.species[0].count = 300;
         s.species[1].positions = RandomPositions{}, s.species[1].velocities = AtRest{}, s.species[1].count = 0;
       }},
      {"Overlapping",
       walls,
       {"disks.1.positions=[[0.5, 0.5], [0.6, 0.5]]"},
       [](Scene& s) {
         s.species[1].positions = ListedPositions{{{0.5, 0.5}, {0.6, 0.5}}};
       }},
      {"OverlappingThroughTheEdge",
       periodic,
       {"disks.1.positions=[[-0.95, 0.5], [0.95, 0.5]]"},
       [](Scene& s) {
         s.species[1].positions = ListedPositions{{{-0.95, 0.5}, {0.95, 0.5}}};
       }},
      {"GrownBesideListed",
       walls,
       {"disks.0.positions={ packing_fraction = 0.5 }"},
       [](Scene& s) { s.species[0].positions = GrownPositions{0.5}; }},
      {"GrownFractionsDiffer",
       walls,
       {"disks.0.positions={ packing_fraction = 0.5 }", "disks.1.positions={ packing_fraction = 0.6 }", "disks.1.count=2"},
       [](Scene& s) { s.species[0].positions = GrownPositions{0.5}, s.species[1].positions = GrownPositions{0.6}; }},
      {"GrownFractionDisagrees",
       walls,
       {"disks.0.positions={ packing_fraction = 0.5 }", "disks.1.positions={ packing_fraction = 0.5 }", "disks.1.count=2"},
       [](Scene& s) { s.species[0].positions = s.species[1].positions = GrownPositions{0.5}; }},
      {"GrownFractionAboveOne",
       walls,
       {"disks.0.positions={ packing_fraction = 1.5 }", "disks.1.positions={ packing_fraction = 1.5 }", "disks.1.count=2"},
       [](Scene& s) { s.species[0].positions = s.species[1].positions = GrownPositions{1.5}; }},
      // ------------------------------------------------------------------------------------------------------ effects
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
      // ------------------------------------------------------------------------------------------------------ the run
      {"TimeNegative", walls, {"run.time=-1.0"}, [](Scene& s) { s.run.time = -1.0; }},
      {"TimeInfinite", walls, {"run.time=inf"}, [](Scene& s) { s.run.time = infinite_number; }},
      {"SampleEveryZero", walls, {"run.sample_every=0.0"}, [](Scene& s) { s.run.sample_every = 0.0; }},
      {"TooManySamples", walls, {"run.sample_every=1e-300"}, [](Scene& s) { s.run.sample_every = 1e-300; }},
      {"SampleEveryNoCollisions",
       walls,
       {"run.sample_every={ collisions = 0 }"},
       [](Scene& s) { s.run.sample_every_collisions = 0; }},
      {"SampleLogBaseOne",
       walls,
       {"run.sample_log={ base = 1.0, per_block = 5, block = 1.0 }"},
       [](Scene& s) {
         s.run.sample_log = SampleLog{1.0, 5, 1.0};
       }},
      {"SampleLogOnePerBlock",
       walls,
       {"run.sample_log={ base = 2.0, per_block = 1, block = 1.0 }"},
       [](Scene& s) {
         s.run.sample_log = SampleLog{2.0, 1, 1.0};
       }},
      {"SampleLogTooFine",
       walls,
       {"run.sample_log={ base = 2.0, per_block = 50, block = 1.0 }"},
       [](Scene& s) {
         s.run.sample_log = SampleLog{2.0, 50, 1.0};
       }},
      {"SampleLogTooMany",
       walls,
       {"run.sample_log={ base = 2.0, per_block = 5, block = 1e-300 }"},
       [](Scene& s) {
         s.run.sample_log = SampleLog{2.0, 5, 1e-300};
       }},
      {"SampleLogBlockZero",
       walls,
       {"run.sample_log={ base = 2.0, per_block = 5, block = 0.0 }"},
       [](Scene& s) {
         s.run.sample_log = SampleLog{2.0, 5, 0.0};
       }},
      {"SampleLogBesideSampleEvery",
       walls,
       {"run.sample_log={ base = 2.0, per_block = 5, block = 1.0 }", "run.sample_every=0.1"},
       [](Scene& s) {
         s.run.sample_log = SampleLog{2.0, 5, 1.0}, s.run.sample_every = 0.1;
       }},
      {"EquilibrateTwice",
       walls,
       {"run.equilibrate={ time = 1.0, collisions_per_disk = 5.0 }"},
       [](Scene& s) {
         s.run.equilibrate = Run::Equilibrate{5.0, 1.0};
       }},
      {"EquilibrateByNothing", walls, {"run.equilibrate={}"}, [](Scene& s) { s.run.equilibrate = Run::Equilibrate{}; }},
      {"EquilibrateNegative",
       walls,
       {"run.equilibrate={ time = -1.0 }"},
       [](Scene& s) {
         s.run.equilibrate = Run::Equilibrate{{}, -1.0};
       }},
      {"CollisionsOfOneDisk",
       walls,
       {"disks.0.count=1", "disks.1.positions=random", "disks.1.count=0", "disks.1.velocities=rest", "run={ collisions = 5 }"},
       [](Scene& s) {
         s.species[0].count = 1;
         s.species[1].positions = RandomPositions{}, s.species[1].velocities = AtRest{}, s.species[1].count = 0;
         s.run.time.reset(), s.run.collisions = 5;
       }},
      // ------------------------------------------------------------------------------------------------------ observables
      {"ObservableUnknown", walls, {"observe.presure=true"}, observe("presure")},
      {"ObservableEveryZero",
       walls,
       {"observe.temperature={ every = 0.0 }"},
       [](Scene& s) { s.observe = {observable("temperature")}, s.observe[0].every = 0.0; }},
      {"ObservableOfOneBin",
       walls,
       {"observe.speeds={ bins = 1 }"},
       [](Scene& s) { s.observe = {observable("speeds")}, s.observe[0].bins = 1; }},
      {"ObservableRangeZero",
       periodic,
       {"observe.hexatic={ range = 0.0 }"},
       [](Scene& s) { s.observe = {observable("hexatic")}, s.observe[0].range = 0.0; }},
      {"ObservableLargestNegative",
       periodic,
       {"observe.structure_factor={ largest = -1.0 }"},
       [](Scene& s) { s.observe = {observable("structure_factor")}, s.observe[0].largest = -1.0; }},
      {"ScatteringAtNegativeK",
       periodic,
       {"observe.intermediate_scattering={ k = -1.0 }"},
       [](Scene& s) { s.observe = {observable("intermediate_scattering")}, s.observe[0].largest = -1.0; }},
      {"ScatteringOfMillionsOfWaves",
       periodic,
       {"observe.intermediate_scattering={ k = 1e12 }"},
       [](Scene& s) { s.observe = {observable("intermediate_scattering")}, s.observe[0].largest = 1e12; }},
      {"ScatteringAtANegativeKOfAList",
       periodic,
       {"observe.intermediate_scattering={ k = [3.0, -1.0] }"},
       [](Scene& s) {
         s.observe = {observable("intermediate_scattering")}, s.observe[0].wave_numbers = {3.0, -1.0};
       }},
      {"ScatteringOfMillionsOfWavesInAList",
       periodic,
       {"observe.intermediate_scattering={ k = [3.0, 1e12] }"},
       [](Scene& s) {
         s.observe = {observable("intermediate_scattering")}, s.observe[0].wave_numbers = {3.0, 1e12};
       }},
      {"ScatteringTwice",
       periodic,
       {"observe.intermediate_scattering={ k = [3.0, 4.0, 3.0] }"},
       [](Scene& s) {
         s.observe = {observable("intermediate_scattering")}, s.observe[0].wave_numbers = {3.0, 4.0, 3.0};
       }},
      {"ScatteringOfTheSameWaves",
       periodic,
       {"observe.intermediate_scattering={ k = [1e-3, 2e-3] }"},
       [](Scene& s) {
         s.observe = {observable("intermediate_scattering")}, s.observe[0].wave_numbers = {1e-3, 2e-3};
       }},
      {"ScatteringAtTooMany",
       periodic,
       {"observe.intermediate_scattering={ k = [" + numbers_up_to(33) + "] }"},
       [](Scene& s) {
         s.observe = {observable("intermediate_scattering")};
         for (int k = 1; k <= 33; ++k) s.observe[0].wave_numbers.push_back(k);
       }},
      {"ScatteringBetweenWalls", walls, {"observe.intermediate_scattering=true"}, observe("intermediate_scattering")},
      {"ClustersWithoutAGap",
       periodic,
       {"observe.clusters={ gap = 0.0 }"},
       [](Scene& s) { s.observe = {observable("clusters")}, s.observe[0].range = 0.0; }},
      {"ClustersAndShear",
       periodic,
       {"observe.clusters=true", "shear.rate=0.1"},
       [=](Scene& s) { observe("clusters")(s), shear(s); }},
      {"ObservableOfNoDisk",
       periodic,
       {"observe.velocity_autocorrelation={ disks = 0 }"},
       [](Scene& s) { s.observe = {observable("velocity_autocorrelation")}, s.observe[0].disks = 0; }},
      {"FieldsWithoutCells",
       periodic,
       {"observe.fields={ cells = [4, 0] }"},
       [](Scene& s) {
         s.observe = {observable("fields")}, s.observe[0].cells = {{4, 0}};
       }},
      {"ObservableBeyondHalfTheBox",
       periodic,
       {"observe.radial_distribution={ range = 50.0 }"},
       [](Scene& s) { s.observe = {observable("radial_distribution")}, s.observe[0].range = 50.0; }},
      {"StructureBetweenWalls", walls, {"observe.radial_distribution=true"}, observe("radial_distribution")},
      {"StructureAndShear",
       periodic,
       {"observe.hexatic=true", "shear.rate=0.1"},
       [=](Scene& s) { observe("hexatic")(s), shear(s); }},
      {"StructureAndGrowth",
       periodic,
       {"observe.hexatic=true", "growth={ rate = 0.1, until = { packing_fraction = 0.5 } }"},
       [=](Scene& s) { observe("hexatic")(s), s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.5}; }},
      {"WallFluxesOfAPeriodicBox", periodic, {"observe.wall_fluxes=true"}, observe("wall_fluxes")},
      {"FlightsAndThermostat",
       periodic,
       {"observe.free_flight=true", "thermostat={ temperature = 1.0, rate = 1.0 }"},
       [=](Scene& s) {
         observe("free_flight")(s), s.effects.thermostat = Thermostat{1.0, 1.0};
       }},
      {"DisplacementAndShear",
       periodic,
       {"observe.mean_square_displacement=true", "shear.rate=0.1"},
       [=](Scene& s) { observe("mean_square_displacement")(s), shear(s); }},
      {"ViscosityBetweenWalls", walls, {"observe.viscosity=true"}, observe("viscosity")},
      {"HeatOfAMixture", periodic, {"observe.heat_conductivity=true"}, observe("heat_conductivity")},
      {"HexaticOfFewDisks",
       periodic,
       {"observe.hexatic=true", "disks.0.count=4"},
       [=](Scene& s) { observe("hexatic")(s), s.species[0].count = 4; }},
  };
}

class FileAndProgramChecks : public testing::TestWithParam<Case> {};

TEST_P(FileAndProgramChecks, RefuseTheSameInTheSameWords) {
  const Case& one = GetParam();
  const std::string text = base_text(one.boundary);
  Scene scene = parse_scene(text);
  ASSERT_NO_THROW(check(scene));
  std::ostringstream saved;
  make_simulation(scene).save(saved);
  const State start = make_simulation(scene).state();

  std::string sentence, with_place;
  try {
    (void)parse_scene(text, "file", one.overrides);
    FAIL() << "the reader accepts it";
  } catch (const SceneError& error) {
    sentence = error.sentence(), with_place = error.what();
  }
  EXPECT_THAT(with_place, HasSubstr(": " + sentence));

  one.change(scene);
  EXPECT_EQ(refusal<SceneError>([&] { check(scene); }), sentence);
  EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene); }), sentence);
  EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene, start); }), sentence);
  EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene, FixedStep{"guarded", 0.01}); }), sentence);
  EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene, start, FixedStep{"guarded", 0.01}); }), sentence);
  std::istringstream back(saved.str());
  EXPECT_EQ(refusal<SceneError>([&] { (void)restore_simulation(scene, back); }), sentence);
}

INSTANTIATE_TEST_SUITE_P(All, FileAndProgramChecks, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& one) { return one.param.name; });

TEST(ProgramChecks, RefusesStatesOfAnotherSize) {
  const Scene scene = parse_scene(base_text("walls"));
  const auto refused = [&](const std::function<void(State&)>& change) {
    State start = make_simulation(scene).state();
    change(start);
    return refusal<std::invalid_argument>([&] { return make_simulation(scene, start); });
  };
  EXPECT_EQ(refused([](State&) {}), "");
  EXPECT_EQ(refused([](State& s) { s.images.resize(2, 0); }), "");
  EXPECT_THAT(refused([](State& s) { s.images.conservativeResize(2, s.images.cols() - 1); }), HasSubstr("images is given for"));
  EXPECT_THAT(refused([](State& s) { s.spins = Eigen::VectorXd::Zero(s.images.cols() + 1); }), HasSubstr("spins is given for"));
  EXPECT_THAT(refused([](State& s) { s.walls.resize(2); }), HasSubstr("a state of 2 walls is given; give all four, or none"));
}

/// What no file can say.
TEST(ProgramChecks, RefusesListsOfTheWrongLengthAndNumbersThatAreNone) {
  const Scene sound = parse_scene(base_text("walls"));
  const auto refused = [&](const std::function<void(Scene&)>& change) {
    Scene scene = sound;
    change(scene);
    const std::string sentence = refusal<SceneError>([&] { check(scene); });
    EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene); }), sentence);
    return sentence;
  };
  EXPECT_EQ(refused([](Scene& s) {
              s.species[1].positions = FilePositions{"start.csv", {{0.0, 0.0}}};
            }),
            "disks.1.count is 2, but positions has 1; make them agree, or leave count out");
  EXPECT_EQ(refused([](Scene& s) {
              s.species[1].velocities = FileVelocities{{{0.0, 0.0}}};
            }),
            "disks.1.velocities has length 1, but there are 2 disks; give one [vx, vy] per disk");
  EXPECT_EQ(refused([](Scene& s) { s.run.sample_every = 0.1, s.run.sample_every_collisions = 10; }),
            "run.sample_every is both a time and a number of collisions; give one of them");
  EXPECT_EQ(refused([](Scene& s) { s.observe = {observable("density_profile")}, s.observe[0].axis = 2; }),
            "observe.density_profile.axis is 2; it must be 0 or 1");
}

/// What only files must say.
TEST(ProgramChecks, LeavesNamesAndTheEndToAProgram) {
  Scene scene = parse_scene(base_text("walls"));
  scene.species[0].name = scene.species[1].name = "";
  scene.run.time.reset();
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.run_until(0.1), StopReason::time);
  Simulation other = make_simulation(scene);
  EXPECT_EQ(refusal<SceneError>([&] { (void)run_schedule(other); }),
            "[run] has no end; give time = 5.0, collisions = 1_000_000, or both");
}

}  // namespace
}  // namespace carom::test
