// Boxes and disks that no file and no program may ask for.

#include "simulation/refused_cases.hpp"

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carom::test {
namespace {

std::vector<RefusedCase> refused_disks() {
  const std::string walls = "walls", periodic = "periodic";
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
  };
}

INSTANTIATE_TEST_SUITE_P(Disks, FileAndProgramChecks, testing::ValuesIn(refused_disks()), name_of);

}  // namespace
}  // namespace carom::test
