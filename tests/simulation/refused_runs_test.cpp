// Ends, samples and observables that no file and no program may ask for.

#include "simulation/refused_cases.hpp"

#include <string>
#include <vector>

namespace carom::test {
namespace {

std::string numbers_up_to(int last) {
  std::string text = "1.0";
  for (int k = 2; k <= last; ++k) text += ", " + std::to_string(k) + ".0";
  return text;
}

std::vector<RefusedCase> refused_runs() {
  const std::string walls = "walls", periodic = "periodic";
  const auto observe = [](const std::string& name) { return [name](Scene& s) { s.observe = {observable(name)}; }; };
  const auto shear = [](Scene& s) { in(s.effects.shear).rate = 0.1; };
  return {
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

INSTANTIATE_TEST_SUITE_P(Runs, FileAndProgramChecks, testing::ValuesIn(refused_runs()), name_of);

}  // namespace
}  // namespace carom::test
